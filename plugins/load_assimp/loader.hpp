// load.assimp: from a mesh file to a Mesh.
//
// Debian's assimp keeps coordinates in 32 bits, which loses the shape of a part that lies far from its origin, and its
// error messages name no line. So the formats that may hold more (STL as text, OBJ, PLY, OFF) are read here in double
// precision, and assimp reads COLLADA and glTF, whose worth lies in the scene: units, node transforms, instances,
// accessors. Both of these are checked first, since assimp trusts the counts and indices it reads.
//
// What a mesh keeps: every triangle of the file, degenerate ones too, in the order of the file; vertices of identical
// coordinates become one; normals, colours and texture coordinates are left out.
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
