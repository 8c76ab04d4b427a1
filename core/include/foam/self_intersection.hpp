// Triangles of one mesh that pass through each other.
#pragma once

#include <foam/mesh.hpp>

#include <utility>
#include <vector>

namespace foam {

/// The pairs (smaller index first, ascending) of triangles of which an edge of one passes through the inside of the
/// other. Touching in a point or an edge, and overlap in a common plane, are no passing through: crossings are counted
/// only where orientation tests in double precision are certain of their sign (error bound of Shewchuk: Adaptive
/// Precision Floating-Point Arithmetic, 1997, section 4.3), even if every coordinate is off by a unit in the last
/// place. O(n log n) for surfaces; deterministic on any number of threads. Precondition: finite vertices, indices in
/// range.
std::vector<std::pair<std::uint32_t, std::uint32_t>> self_intersections(const Mesh& mesh);

} // namespace foam
