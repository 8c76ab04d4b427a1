// The files with meshes below a folder.
#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace foam {

/// Relative to `folder`, sorted; empty if the folder is not there.
inline std::vector<std::string> mesh_files_below(const std::filesystem::path& folder) {
    static const std::set<std::string> endings{".stl", ".obj", ".ply", ".off", ".dae", ".gltf", ".glb"};
    std::vector<std::string> files;
    std::error_code absent;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, absent)) {
        std::string ending = entry.path().extension().string();
        std::transform(ending.begin(), ending.end(), ending.begin(),
                       [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        if (endings.contains(ending)) {
            files.push_back(std::filesystem::relative(entry.path(), folder).string());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

/// Fit for the name of a test.
inline std::string name_of_case(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
    return text;
}

} // namespace foam
