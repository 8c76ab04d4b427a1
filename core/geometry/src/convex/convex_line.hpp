// Where a line is inside simple convex bodies.
#pragma once

#include <foam/geometry/element.hpp>

namespace foam::inline geometry {

using MaybePart = std::optional<LinePart>;

inline MaybePart intersection(const MaybePart& a, const MaybePart& b) {
    if (!a || !b) {
        return {};
    }
    const LinePart both{std::max(a->enter, b->enter), std::min(a->leave, b->leave)};
    return both.enter < both.leave ? MaybePart(both) : MaybePart();
}

/// Returns the smallest part that contains both. It is their union where they overlap or touch.
inline MaybePart around(const MaybePart& a, const MaybePart& b) {
    if (!a || !b) {
        return a ? a : b;
    }
    return LinePart{std::min(a->enter, b->enter), std::max(a->leave, b->leave)};
}

/// Returns where |o + t d| <= half.
inline MaybePart in_slab(double o, double d, double half) {
    if (d == 0) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        return std::abs(o) <= half ? MaybePart(LinePart{-infinity, infinity}) : MaybePart();
    }
    const double t1 = (-half - o) / d, t2 = (half - o) / d;
    return LinePart{std::min(t1, t2), std::max(t1, t2)};
}

/// Returns where a t² + 2 b t + c <= 0, a >= 0.
inline MaybePart in_quadric(double a, double b, double c) {
    if (a == 0) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        return c <= 0 ? MaybePart(LinePart{-infinity, infinity}) : MaybePart();
    }
    const double discriminant = b * b - a * c;
    if (discriminant <= 0) {
        return {};
    }
    const double q = std::sqrt(discriminant);
    return LinePart{(-b - q) / a, (-b + q) / a};
}

/// Returns where the line is inside a ball about the origin.
inline MaybePart in_ball(const Vec3& o, const Vec3& d, double radius) {
    return in_quadric(squared_norm(d), dot(o, d), squared_norm(o) - radius * radius);
}

/// Returns where the line is inside an endless tube about the z axis.
inline MaybePart in_tube(const Vec3& o, const Vec3& d, double radius) {
    return in_quadric(d.x * d.x + d.y * d.y, o.x * d.x + o.y * d.y, o.x * o.x + o.y * o.y - radius * radius);
}

/// Returns where the line is inside the box [-half, half].
inline MaybePart in_box(const Vec3& o, const Vec3& d, const Vec3& half) {
    return intersection(in_slab(o.x, d.x, half.x), intersection(in_slab(o.y, d.y, half.y), in_slab(o.z, d.z, half.z)));
}

/// Returns where the line is inside the cylinder |z| <= half.
inline MaybePart in_cylinder(const Vec3& o, const Vec3& d, double radius, double half) {
    return intersection(in_tube(o, d, radius), in_slab(o.z, d.z, half));
}

/// Returns where the line is inside the capsule about the segment |z| <= half.
inline MaybePart in_capsule(const Vec3& o, const Vec3& d, double radius, double half) {
    return around(in_cylinder(o, d, radius, half),
                  around(in_ball(o - Vec3{0, 0, half}, d, radius), in_ball(o + Vec3{0, 0, half}, d, radius)));
}

} // namespace foam::geometry
