// The surface between solid and outside cells as a closed 2-manifold (Huang, Su, Guibas 2018, section 3.2).
#pragma once

#include "octree.hpp"

#include <foam/geometry/mesh.hpp>

#include <array>
#include <vector>

namespace foam::repair {

/// Two triangles that share a diagonal: a face of a cell.
struct Quad {
    std::array<std::uint32_t, 4> corners;
    std::uint32_t first_triangle; ///< and the one after it
};

struct VoxelSurface {
    Mesh mesh;                            ///< in the octree's unit cube
    std::vector<Quad> quads;              ///< faces whose diagonal may be changed
    std::vector<std::vector<Cell>> cells; ///< of each vertex: the solid cells whose faces meet there
};

/// Returns the surface. Solid cells are joined across faces only. Where two of them touch in an edge or a corner, each
/// gets its own vertices. An edge that occurs twice gets a midpoint for each occurrence, so that no two edges have the
/// same ends.
VoxelSurface voxel_surface(const Octree& octree, Context& context);

} // namespace foam::repair
