// Plane polygons cut into triangles.
#pragma once

#include <foam/geometry/mesh.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// Returns the triangles of a plane polygon in 3-space by ear clipping (Meisters 1975). Convex polygons become the fan
/// of corner 0. Always gives corners - 2 triangles, also for a polygon that intersects itself. `work`: the number of
/// corner visits that are left, reduced by those used. Empty if that is not enough. O(n) if it is convex, at worst
/// O(n^2) for n corners, more if it is tangled.
std::vector<Triangle> triangulated(std::span<const Vec3> corners, std::size_t& work);

} // namespace geometry
} // namespace foam
