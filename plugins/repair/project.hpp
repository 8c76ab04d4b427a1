// Vertices of the voxel surface are drawn to the input (Huang, Su, Guibas 2018, section 3.3).
#pragma once

#include "nearby.hpp"
#include "voxel_surface.hpp"

#include <foam/context.hpp>
#include <foam/solid.hpp>

namespace foam::repair {

struct ProjectOptions {
    /// Distance that vertices keep from the surface of a solid and from a sheet that has no inside, in cells.
    double off_solids = 0, off_sheets = 0;
    int rounds = 10; ///< of smoothing and projection
};

/// Moves the vertices of `surface` to just outside of the input, whose inside `solid` knows. A vertex never passes
/// through a triangle of the input, so both sides of a thin sheet stay on their sides; and no move turns a triangle
/// over. Returns the share of the vertices that stand over sheets.
double project(VoxelSurface& surface, const Nearby& nearby, const Solid& solid, double cell,
               const ProjectOptions& options, Context& context);

} // namespace foam::repair
