// The files that assimp may open: the mesh file and files in its folder, read by foam with its limits, from memory.
#pragma once

#include <assimp/IOSystem.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace foam::load_assimp {

/// The remedy for files of more than max_bytes.
inline constexpr std::string_view too_large_remedy = "simplify the mesh, or raise max_bytes of load.assimp";

/// A read-only file system for assimp. Beside the mesh file only files in its folder or below can be opened. All
/// together have at most `max_bytes`.
class Files final : public Assimp::IOSystem {
public:
    /// Reads `file`. Throws Error(input).
    Files(const std::filesystem::path& file, std::uintmax_t max_bytes);

    /// Returns the name of the mesh for assimp.
    std::string mesh() const { return mesh_.string(); }

    bool Exists(const char* file) const override;
    char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* file, const char* mode) override;
    void Close(Assimp::IOStream* stream) override;

    /// Returns the requested files that could not be opened: "NAME: why".
    const std::vector<std::string>& refused() const { return refused_; }

private:
    /// Returns the path of a name that assimp requests; empty: outside of the folder.
    std::filesystem::path place_of(const char* file) const;

    std::filesystem::path mesh_, folder_;
    std::uintmax_t bytes_left_;
    std::map<std::filesystem::path, std::string> contents_;
    std::vector<std::string> refused_;
};

} // namespace foam::load_assimp
