// Removes intersections between triangles of a rebuilt surface.
#pragma once

#include <foam/geometry/mesh.hpp>
#include <foam/sdk/context.hpp>

namespace foam::repair {

/// Removes intersections. `mesh` is `voxels` with its vertices projected to the input. Vertices of triangles that
/// intersect move back towards their voxel positions, by halves and finally completely, until no triangles intersect:
/// the faces of voxels never do. Returns the number of vertices that moved back.
std::size_t untangle(Mesh& mesh, const Mesh& voxels, Context& context);

} // namespace foam::repair
