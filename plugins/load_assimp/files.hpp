// The files that assimp may open: the mesh file and those beside it, read by foam with its limits, from memory.
#pragma once

#include <assimp/IOSystem.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace foam::load_assimp {

/// What to do with files of more than max_bytes.
inline constexpr std::string_view too_large_remedy = "simplify the mesh, or raise max_bytes of load.assimp";

/// Nothing is written. Of other files only those in the folder of the mesh file or below it can be opened, and all
/// together have no more than `max_bytes`.
class Files final : public Assimp::IOSystem {
public:
    /// Reads `file`. Throws Error(input).
    Files(const std::filesystem::path& file, std::uintmax_t max_bytes);

    /// The name by which assimp is to ask for the mesh.
    std::string mesh() const { return mesh_.string(); }

    bool Exists(const char* file) const override;
    char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char* file, const char* mode) override;
    void Close(Assimp::IOStream* stream) override;

    /// Other files that were asked for and could not be had: "NAME: why".
    const std::vector<std::string>& refused() const { return refused_; }

private:
    /// Where a name that assimp asks for leads; empty: out of the folder.
    std::filesystem::path place_of(const char* file) const;

    std::filesystem::path mesh_, folder_;
    std::uintmax_t bytes_left_;
    std::map<std::filesystem::path, std::string> contents_;
    std::vector<std::string> refused_;
};

} // namespace foam::load_assimp
