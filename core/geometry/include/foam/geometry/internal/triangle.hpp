// Single triangles: nearest point and solid angle.
#pragma once

#include <foam/geometry/vector.hpp>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// The corners, copied from the mesh so that queries read memory in order.
struct Corners {
    Vec3 a, b, c;
};

/// Returns the point of the triangle nearest to `p` (Ericson, Real-Time Collision Detection 2005, section 5.1.5).
/// Degenerate triangles are segments or points.
Vec3 closest_on_triangle(const Corners& t, const Vec3& p);

/// Returns the solid angle of the triangle seen from `p`, in steradians divided by 4π: its share of the winding number.
/// Positive if `p` is behind the triangle. Van Oosterom and Strackee 1983, equation 8.
double winding_of_triangle(const Corners& t, const Vec3& p);

} // namespace geometry
} // namespace foam
