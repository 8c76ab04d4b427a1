// load.assimp: mesh files through the library assimp, for formats that load.mesh does not read.
//
// assimp takes counts, ranges and nesting of a file on trust. So it is to run in a process of its own (StageInfo),
// opens no file but through Files, and what it makes is checked before anything else looks at it.
#pragma once

#include <foam/stage.hpp>

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
