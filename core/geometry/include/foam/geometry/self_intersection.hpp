// Triangles of one mesh that intersect each other.
#pragma once

#include <foam/geometry/mesh.hpp>

#include <utility>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// Returns the pairs of triangles (smaller index first, ascending) where an edge of one passes through the interior of
/// the other. Touching in a point or an edge, and overlap in a common plane, do not count. Crossings are counted only
/// where orientation tests in double precision are certain of their sign (error bound of Shewchuk: Adaptive Precision
/// Floating-Point Arithmetic, 1997, section 4.3), even if every coordinate is off by a unit in the last place. O(n log
/// n) for surfaces; deterministic on any number of threads. Precondition: finite vertices, indices in range.
std::vector<std::pair<std::uint32_t, std::uint32_t>> self_intersections(const Mesh& mesh);

} // namespace geometry
} // namespace foam
