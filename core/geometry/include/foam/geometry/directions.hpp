// Directions spread evenly over the sphere.
#pragma once

#include <foam/geometry/vector.hpp>

#include <cstddef>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// Returns `count` unit vectors on the Fibonacci lattice, each for the same share of the sphere (González 2010, with
/// the offset of one half at the poles).
std::vector<Vec3> fibonacci_directions(std::size_t count);

} // namespace geometry
} // namespace foam
