// Hulls with few vertices, outwards.
#pragma once

#include <foam/geometry/element.hpp>

#include <cstddef>
#include <memory>

namespace foam::inline search::convex {

/// Returns a polytope with at most `most` vertices (at least 4) that contains the given one. Edges are collapsed, those
/// that add least volume first, each to the point beyond the planes of all triangles at its ends for which the added
/// volume is least: a linear programme (progressive hulls: Sander, Gu, Gortler, Hoppe, Snyder 2000).
std::shared_ptr<const Polytope> with_fewer_vertices(const Polytope& polytope, std::size_t most);

} // namespace foam::inline search::convex
