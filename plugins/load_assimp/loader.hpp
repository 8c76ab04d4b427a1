// load.assimp: mesh files through the library assimp, for formats that load.mesh does not read.
//
// assimp trusts counts, ranges and nesting of a file. Therefore it requests process isolation (StageInfo), opens files
// only through Files, and its result is checked before any other use.
#pragma once

#include <foam/sdk/stage.hpp>

namespace foam::load_assimp {

class Loader final : public MeshLoader {
public:
    explicit Loader(const Parameters& parameters);
    Mesh load(const std::filesystem::path& file, Context& context) const override;

private:
    std::size_t max_triangles_;
    std::uintmax_t max_bytes_;
};

} // namespace foam::load_assimp
