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

/// Returns the shared meshes that are refused: no reader can make a mesh of them, or what they hold is 10^39 m large.
inline const std::set<std::string>& unreadable_meshes() {
    static const std::set<std::string> files{"real/malformed.obj",
                                             "real/Cray_right.obj",
                                             "real/invalid.off",
                                             "real/IndexOutOfRange.gltf",
                                             "real/BoxWithInfinites.glb",
                                             "synthetic/empty.stl",
                                             "synthetic/empty.obj",
                                             "synthetic/header_only.stl",
                                             "synthetic/truncated_binary.stl",
                                             "synthetic/count_too_large.stl",
                                             "synthetic/nan_vertex.stl",
                                             "synthetic/inf_vertex.obj",
                                             "synthetic/index_out_of_range.obj",
                                             "synthetic/points_only.ply",
                                             "synthetic/garbage.stl"};
    return files;
}

/// Fit for the name of a test.
inline std::string name_of_case(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
    return text;
}

} // namespace foam
