// Vertices of the voxel surface are drawn to the input (Huang, Su, Guibas 2018, section 3.3).
#pragma once

#include "octree.hpp"
#include "voxel_surface.hpp"

#include <foam/context.hpp>

namespace foam::watertight {

struct ProjectOptions {
    double stand_off = 0; ///< distance that vertices keep from the input's surface, in the unit cube
    int rounds = 10;      ///< of smoothing and projection
};

/// Moves the vertices of `surface` to `stand_off` outside of `input`. A vertex never passes through a triangle of the
/// input, so both sides of a thin sheet stay on their sides; and no move turns a triangle over.
void project(VoxelSurface& surface, const Mesh& input, const Octree& octree, const ProjectOptions& options,
             Context& context);

} // namespace foam::watertight
