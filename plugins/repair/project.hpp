// The projection of the vertices of the voxel surface to the input (Huang, Su, Guibas 2018, section 3.3).
#pragma once

#include "nearby.hpp"
#include "voxel_surface.hpp"

#include <foam/geometry/solid.hpp>
#include <foam/sdk/context.hpp>

namespace foam::repair {

struct ProjectOptions {
    /// The distances of vertices from the surface of a solid and from a sheet without inside, in cells.
    double off_solids = 0, off_sheets = 0;
    int rounds = 10; ///< of smoothing and projection
};

/// Moves the vertices of `surface` to just outside of the input, whose inside `solid` determines. A vertex never passes
/// through a triangle of the input, so both sides of a thin sheet stay on their sides. No move inverts a triangle.
/// Returns the share of the vertices over sheets.
double project(VoxelSurface& surface, const Nearby& nearby, const Solid& solid, double cell,
               const ProjectOptions& options, Context& context);

} // namespace foam::repair
