// No triangle of a rebuilt surface passes through another.
#pragma once

#include <foam/context.hpp>
#include <foam/mesh.hpp>

namespace foam::repair {

/// `mesh` is `voxels` with its vertices drawn to the input. Where triangles pass through each other, their vertices go
/// back towards where they were, by halves and at last wholly, until none does: the faces of voxels never do. Returns
/// the number of vertices that had to go back.
std::size_t untangle(Mesh& mesh, const Mesh& voxels, Context& context);

} // namespace foam::repair
