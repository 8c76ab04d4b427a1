// On which side of a plane a point is, without rounding.
#pragma once

#include <foam/geometry/vector.hpp>

namespace foam::inline geometry {

/// Returns the sign of det(b - a, c - a, p - a): 1 if p is on the side from which a, b, c go counter-clockwise, -1 on
/// the other side, 0 on the plane. Exact (Shewchuk 1997, "Adaptive precision floating-point arithmetic and fast robust
/// geometric predicates") if no product of three differences of coordinates overflows or underflows.
int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p);

} // namespace foam::geometry
