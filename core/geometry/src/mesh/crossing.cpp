#include <foam/geometry/internal/triangles.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace foam::inline geometry {
namespace {

double largest_coordinate(const Vec3& p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

double sum_of_components(const Vec3& v) {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

/// Returns the sign of the volume of a b c d, positive if d is below the counter-clockwise triangle a b c; 0 where
/// rounding could change it: of this computation, or of the coordinates themselves by a unit in the last place.
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 u = a - d, v = b - d, w = c - d;
    const double determinant =
        u.x * (v.y * w.z - v.z * w.y) + v.x * (w.y * u.z - w.z * u.y) + w.x * (u.y * v.z - u.z * v.y);
    const double permanent = std::abs(u.x) * (std::abs(v.y * w.z) + std::abs(v.z * w.y)) +
                             std::abs(v.x) * (std::abs(w.y * u.z) + std::abs(w.z * u.y)) +
                             std::abs(w.x) * (std::abs(u.y * v.z) + std::abs(u.z * v.y));
    const double coordinate =
        std::max({largest_coordinate(a), largest_coordinate(b), largest_coordinate(c), largest_coordinate(d)});
    const auto sign_beyond = [&](double lu, double lv, double lw) {
        // Shewchuk's 7 ε/2 with margin; 2 ε of a coordinate in each of the three differences.
        const double bound =
            8 * std::numeric_limits<double>::epsilon() * (permanent + coordinate * (lu * lv + lv * lw + lw * lu));
        return determinant > bound ? 1 : determinant < -bound ? -1 : 0;
    };
    // Upper estimates of lengths, without roots, decide nearly always.
    const int sign = sign_beyond(sum_of_components(u), sum_of_components(v), sum_of_components(w));
    return sign != 0 ? sign : sign_beyond(norm(u), norm(v), norm(w));
}

/// Returns whether the segment, which ends on both sides of the triangle's plane, passes through the interior of the
/// triangle.
bool passes_through(const Vec3& from, const Vec3& to, const TriangleCorners& t) {
    const int first = orientation(from, to, t[0], t[1]);
    return first != 0 && first == orientation(from, to, t[1], t[2]) && first == orientation(from, to, t[2], t[0]);
}

} // namespace

bool side_passes_through(const TriangleCorners& sides, const TriangleCorners& target,
                         const std::array<bool, 3>& shared) {
    std::array<int, 3> above{}; // side of the plane
    for (std::size_t s = 0; s < 3; ++s) {
        above[s] = shared[s] ? 0 : orientation(target[0], target[1], target[2], sides[s]);
    }
    for (std::size_t s = 0; s < 3; ++s) {
        const std::size_t e = (s + 1) % 3;
        if (above[s] * above[e] < 0 && passes_through(sides[s], sides[e], target)) {
            return true;
        }
    }
    return false;
}

} // namespace foam::inline geometry
