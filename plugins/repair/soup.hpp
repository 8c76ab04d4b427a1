// Small defects mended where they are; what is sound stays as it is.
#pragma once

#include "clean.hpp"

namespace foam::repair {

struct SoupOptions {
    double seam = 1e-6; ///< vertices this near to each other, or to an edge, are meant to be one: share of the diagonal
    double largest_hole = 0.1; ///< extent of holes that are filled although they are not flat: share of the diagonal
};

/// The mesh without changing its shape, if it bounds a solid but for facing, repeats, triangles without area and seams.
std::optional<Mesh> sound(const Cleaned& cleaned, const SoupOptions& options, Context& context);

/// The triangles as a closed, oriented 2-manifold of positive volume: seams sewn, T-junctions joined, patches turned
/// outwards by the winding number, walls between bodies taken out, holes filled, bodies that touch separated. Nothing
/// if that is not enough. Says through the context what was done.
std::optional<Mesh> mended(const Cleaned& cleaned, const SoupOptions& options, Context& context);

} // namespace foam::repair
