// Local repairs of small defects; sound parts stay unchanged.
#pragma once

#include "clean.hpp"

namespace foam::repair {

struct SoupOptions {
    double seam = 1e-6; ///< vertices this near to each other, or to an edge, are meant to be one: share of the diagonal
    double largest_hole = 0.1; ///< extent of filled holes that are not flat: share of the diagonal
};

/// Returns the mesh in its shape, if it bounds a solid except for facing, repeats, triangles without area and seams.
std::optional<Mesh> sound(const Cleaned& cleaned, const SoupOptions& options, Context& context);

/// Returns the triangles as a closed, oriented 2-manifold of positive volume: seams sewn, T-junctions joined, patches
/// turned outwards by the winding number, walls between bodies removed, holes filled, touching bodies separated.
/// Nothing if that is not enough. Reports the repairs through the context.
std::optional<Mesh> mended(const Cleaned& cleaned, const SoupOptions& options, Context& context);

} // namespace foam::repair
