#include "scene.hpp"

#include <foam/base/error.hpp>
#include <foam/base/file.hpp>

#include <assimp/MemoryIOWrapper.h>
#include <fmt/format.h>

#include <algorithm>

namespace foam::load_assimp {
namespace fs = std::filesystem;

Files::Files(const fs::path& file, std::uintmax_t max_bytes)
    : mesh_(fs::absolute(file).lexically_normal()), folder_(mesh_.parent_path()), bytes_left_(max_bytes) {
    FileContents read = read_regular_file(file, max_bytes, too_large_remedy);
    if (!read.problem.empty()) {
        throw Error(ErrorCode::input, fmt::format("{}: {}", file.string(), read.why_not()));
    }
    if (read.bytes.empty()) {
        throw Error(ErrorCode::input, fmt::format("{}: the file is empty; remedy: export it again", file.string()));
    }
    bytes_left_ -= read.bytes.size();
    contents_.emplace(mesh_, std::move(read.bytes));
}

fs::path Files::place_of(const char* file) const {
    if (file == mesh_) {
        return mesh_; // whatever characters its name has
    }
    std::string name = file;
    std::replace(name.begin(), name.end(), '\\', '/'); // formats from Windows
    const fs::path place = (folder_ / name).lexically_normal();
    const fs::path within = place.lexically_relative(folder_);
    return within.empty() || *within.begin() == ".." ? fs::path() : place;
}

bool Files::Exists(const char* file) const {
    const fs::path place = place_of(file);
    std::error_code error;
    return contents_.contains(place) || (!place.empty() && fs::is_regular_file(place, error));
}

Assimp::IOStream* Files::Open(const char* file, const char* mode) {
    const fs::path place = place_of(file);
    auto known = contents_.find(place);
    if (std::string_view(mode).find_first_of("wa+") != std::string_view::npos) {
        return nullptr;
    }
    if (known == contents_.end()) {
        FileContents read;
        if (place.empty()) {
            read.problem = "it lies outside of the folder of the mesh";
        } else {
            read = read_regular_file(place, bytes_left_, too_large_remedy);
        }
        if (!read.problem.empty()) {
            refused_.push_back(fmt::format("{}: {}", file, read.problem));
            return nullptr;
        }
        bytes_left_ -= read.bytes.size();
        known = contents_.emplace(place, std::move(read.bytes)).first;
    }
    const std::string& bytes = known->second;
    return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

void Files::Close(Assimp::IOStream* stream) {
    delete stream;
}

} // namespace foam::load_assimp
