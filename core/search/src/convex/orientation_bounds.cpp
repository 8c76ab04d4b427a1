#include "least_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace foam::inline search::convex {
namespace {

constexpr double pi = std::numbers::pi;

/// Returns a length that the points' extent along no axis within the angle falls short of.
double least_extent(const Cloud& cloud, const Vec3& axis, double angle) {
    const auto [low, high] =
        std::minmax_element(cloud.points.begin(), cloud.points.end(),
                            [&](const Vec3& a, const Vec3& b) { return dot(a, axis) < dot(b, axis); });
    const Vec3 d = *high - *low;
    const double length = norm(d);
    const double between = std::acos(std::min(1.0, dot(d, axis) / length)); // 0 where the length is
    return std::max(length * std::cos(between + angle), 2 * thin);
}

/// Returns the radius of a capsule of a volume whose core has length 1.
double capsule_radius(double volume_of) {
    double low = 0, high = 1 + volume_of; // a cylinder of that radius has more
    for (int i = 0; i < 60; ++i) {
        const double r = (low + high) / 2;
        (pi * r * r + 4 * pi / 3 * r * r * r < volume_of ? low : high) = r;
    }
    return high;
}

} // namespace

std::vector<Orientations> all_orientations(bool of_axis) {
    if (!of_axis) {
        return {{.half = std::tan(pi / 8) * (1 + 1e-12)}};
    }
    return {{.half = 1, .face = 0}, {.half = 1, .face = 1}, {.half = 1, .face = 2}};
}

std::vector<Orientations> parts_of(const Orientations& cell, bool of_axis) {
    const double h = cell.half / 2;
    std::vector<Orientations> parts(of_axis ? 4 : 8, cell);
    for (std::size_t k = 0; k < parts.size(); ++k) {
        parts[k].half = h;
        parts[k].at += {k & 1 ? h : -h, k & 2 ? h : -h, of_axis ? 0 : (k & 4 ? h : -h)};
    }
    return parts;
}

std::array<Vec3, 3> axes_at(const Vec3& r) {
    const double n = norm(r);
    const Pose turn = n > 0 ? Pose::from_axis_angle(r / n, 2 * std::atan(n)) : Pose{};
    return {turn.rotation[0], turn.rotation[1], turn.rotation[2]};
}

Vec3 direction_at(const Orientations& cell) {
    Vec3 d;
    d[cell.face] = 1;
    d[(cell.face + 1) % 3] = cell.at.x;
    d[(cell.face + 2) % 3] = cell.at.y;
    return normalized(d);
}

double reach(const Orientations& cell, bool of_axis) {
    double angle = 0;
    for (int k = 0; k < (of_axis ? 4 : 8); ++k) {
        const Vec3 off{k & 1 ? cell.half : -cell.half, k & 2 ? cell.half : -cell.half,
                       of_axis ? 0 : (k & 4 ? cell.half : -cell.half)};
        // Between (1, at) and (1, corner): a cosine near 1 would not tell small angles apart.
        const double across = std::sqrt(squared_norm(off) + squared_norm(cross(cell.at, off)));
        angle = std::max(angle, std::atan2(across, 1 + dot(cell.at, cell.at + off)));
    }
    angle += 1e-12;
    return of_axis ? angle : 2 * angle; // quaternions turn by half the angle
}

double bound_of_box(const Cloud& cloud, const std::array<Vec3, 3>& axes, double angle) {
    double bound = 1;
    for (const Vec3& axis : axes) {
        bound *= least_extent(cloud, axis, angle);
    }
    return bound;
}

/// The least cylinder along another direction, turned to this one, is in a cylinder whose radius is larger by half its
/// length times the sine; its length is at most what this one's becomes when it is turned there.
double bound_of_cylinder(const Cloud& cloud, const Fit& here, double angle) {
    const double sine = std::sin(angle);
    const double length = 2 * here.half.z + 2 * here.radius * sine;
    const double radius = std::max(here.radius - length / 2 * sine, thin);
    return pi * radius * radius * least_extent(cloud, here.axes[2], angle);
}

/// A capsule along another direction, turned to this one, is in one whose radius is larger by its length times the sine
/// of half the angle. So the least volume there is at least that here without a layer of this thickness. The layer of
/// the longest capsule, as long as the points are large, is the most. At constant volume V(r, l), r falls with l by
/// r' = -V_l / V_r. The derivative of l V_r is V_r + l (2 pi r - (2 pi l + 8 pi r) pi r^2 / V_r), which is above V_r.
double bound_of_capsule(double here, double angle) {
    const double r = capsule_radius(here);
    return here - std::sin(angle / 2) * (2 * pi * r + 4 * pi * r * r);
}

} // namespace foam::inline search::convex
