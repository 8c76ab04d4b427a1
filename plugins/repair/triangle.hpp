// Queries on one triangle.
#pragma once

#include <foam/geometry/mesh.hpp>

#include <array>
#include <cstdint>

namespace foam::repair {

/// In place of the index of a triangle or vertex that there is not.
inline constexpr std::uint32_t no_index = 0xFFFFFFFFu;

using Corners = std::array<Vec3, 3>;

inline Corners corners(const Mesh& mesh, const Triangle& t) {
    return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}
/// Returns twice the area along the normal.
inline Vec3 area_vector(const Corners& t) {
    return cross(t[1] - t[0], t[2] - t[0]);
}
/// Returns whether the three corners are collinear to rounding.
bool is_degenerate(const Corners& t);
/// Returns the point of the triangle nearest to `p` (Ericson, Real-Time Collision Detection, 2005, 5.1.5).
Vec3 closest_point(const Corners& t, const Vec3& p);
/// Returns whether the closed cube about `center` and the triangle have a common point: separating axes (Akenine-Möller
/// 2001).
bool overlaps_cube(const Corners& t, const Vec3& center, double half_size);
/// Returns whether the segment from `a` to `b` passes through the triangle. Touching counts, lying in its plane does
/// not.
bool crosses(const Corners& t, const Vec3& a, const Vec3& b);
/// Returns the solid angle of the triangle seen from `p`, positive if `p` is behind it (van Oosterom, Strackee 1983).
double solid_angle(const Corners& t, const Vec3& p);

} // namespace foam::repair
