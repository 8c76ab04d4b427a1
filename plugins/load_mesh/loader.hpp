// load.mesh: from a mesh file to a Mesh.
//
// Each format has a reader of its own, which calculates in double precision (a part that lies far from its origin keeps
// its shape), trusts no count or index of the file, and names the place of what is wrong.
//
// What a mesh keeps: every triangle of the file, degenerate ones too, in the order of the file; vertices of identical
// coordinates become one; normals, colours and texture coordinates are left out.
#pragma once

#include "builder.hpp"

#include <foam/stage.hpp>

namespace foam::load_mesh {

class Loader final : public MeshLoader {
public:
    explicit Loader(const Parameters& parameters);
    Mesh load(const std::filesystem::path& file, Context& context) const override;

private:
    Limits limits_;
};

} // namespace foam::load_mesh
