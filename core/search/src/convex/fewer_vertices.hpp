// Hulls with few vertices, outwards.
#pragma once

#include <foam/geometry/element.hpp>

#include <cstddef>
#include <memory>

namespace foam::inline search::convex {

/// Returns a polytope with at most `most` vertices (at least 4) that contains the given one, to about 1e-9 of its
/// size: by CollapsingHull. A box around it, or a tetrahedron, where that cannot reach the number.
std::shared_ptr<const Polytope> with_fewer_vertices(const Polytope& polytope, std::size_t most);

} // namespace foam::inline search::convex
