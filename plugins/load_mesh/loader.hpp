// load.mesh: from a mesh file to a Mesh.
//
// Each format has its own reader. Readers calculate in double precision, so that a part far from its origin keeps its
// shape. They trust no count or index of the file, and name the place of an error.
//
// A mesh has every triangle of the file, also degenerate ones, in the order of the file. Vertices with identical
// coordinates become one. Normals, colours and texture coordinates are left out.
#pragma once

#include "builder.hpp"

#include <foam/sdk/stage.hpp>

namespace foam::load_mesh {

class Loader final : public MeshLoader {
public:
    explicit Loader(const Parameters& parameters);
    Mesh load(const std::filesystem::path& file, Context& context) const override;

private:
    Limits limits_;
};

} // namespace foam::load_mesh
