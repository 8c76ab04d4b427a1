// Vectors, rotations, and directions over a sphere.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

// Points, rigid transforms and boxes. Plain data: safe to pass between plugins built with different vector
// instruction sets (no over-aligned types). Units: metres and radians.

/// A point or direction in 3-space.
struct Vec3 {
    double x = 0, y = 0, z = 0;

    constexpr double operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
    constexpr double& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
    constexpr bool operator==(const Vec3&) const = default;
};

constexpr Vec3 operator+(const Vec3& a, const Vec3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Vec3 operator-(const Vec3& a, const Vec3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Vec3 operator-(const Vec3& a) {
    return {-a.x, -a.y, -a.z};
}
constexpr Vec3 operator*(const Vec3& a, double s) {
    return {a.x * s, a.y * s, a.z * s};
}
constexpr Vec3 operator*(double s, const Vec3& a) {
    return a * s;
}
constexpr Vec3 operator/(const Vec3& a, double s) {
    return {a.x / s, a.y / s, a.z / s};
}
constexpr Vec3& operator+=(Vec3& a, const Vec3& b) {
    return a = a + b;
}
constexpr Vec3& operator-=(Vec3& a, const Vec3& b) {
    return a = a - b;
}
constexpr Vec3& operator*=(Vec3& a, double s) {
    return a = a * s;
}

constexpr double dot(const Vec3& a, const Vec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
constexpr double squared_norm(const Vec3& a) {
    return dot(a, a);
}
inline double norm(const Vec3& a) {
    return std::sqrt(dot(a, a));
}
inline double distance(const Vec3& a, const Vec3& b) {
    return norm(a - b);
}
/// Returns the unit vector along `a`; the zero vector stays zero.
inline Vec3 normalized(const Vec3& a) {
    const double length = norm(a);
    return length > 0 ? a / length : Vec3{};
}
inline bool is_finite(const Vec3& a) {
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// A rigid transform: p ↦ R p + t. `rotation` is row-major.
struct Pose {
    std::array<Vec3, 3> rotation{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    Vec3 translation{};

    constexpr bool operator==(const Pose&) const = default;

    constexpr Vec3 rotate(const Vec3& v) const {
        return {dot(rotation[0], v), dot(rotation[1], v), dot(rotation[2], v)};
    }
    constexpr Vec3 operator*(const Vec3& p) const { return rotate(p) + translation; }
    Pose operator*(const Pose& other) const;
    Pose inverse() const;

    /// Returns the pose by the URDF convention: rotation about fixed axes x (roll), y (pitch), z (yaw), in that order;
    /// radians.
    static Pose from_xyz_rpy(const Vec3& xyz, const Vec3& rpy);
    /// Returns the rotation by `angle` radians about the unit vector `axis`.
    static Pose from_axis_angle(const Vec3& axis, double angle);
};

/// An axis-aligned box; empty until a point is added.
struct Box {
    Vec3 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
             std::numeric_limits<double>::infinity()};
    Vec3 high = -low;

    bool empty() const { return !(low.x <= high.x); }
    Vec3 center() const { return (low + high) * 0.5; }
    Vec3 size() const { return empty() ? Vec3{} : high - low; }
    double diagonal() const { return norm(size()); }
    /// Returns the box that reaches so far from a point along each axis.
    static Box about(const Vec3& center, const Vec3& reach) {
        Box box;
        box.add(center - reach);
        box.add(center + reach);
        return box;
    }
    void add(const Vec3& p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    void add(const Box& other) {
        if (!other.empty()) {
            add(other.low);
            add(other.high);
        }
    }
};

/// Returns the unit quaternion (w, x, y, z) of a rotation (Shepperd 1978), with w >= 0.
std::array<double, 4> quaternion(const Pose& pose);
/// Returns the pose of a quaternion (w, x, y, z), which is made a unit one first, as most programs do.
/// Precondition: it is finite and not 0.
Pose from_quaternion(const Vec3& translation, const std::array<double, 4>& wxyz);
/// Returns roll, pitch and yaw of a rotation by the URDF convention (Pose::from_xyz_rpy), exact to rounding also where
/// the pitch is a right angle.
Vec3 roll_pitch_yaw(const Pose& pose);
/// Returns such angles with few decimals if they give exactly this rotation, as those of a rotation that was made from
/// rounded angles; else those of roll_pitch_yaw().
Vec3 short_roll_pitch_yaw(const Pose& pose);

/// Returns `count` unit vectors on the Fibonacci lattice, each for the same share of the sphere (González 2010, with
/// the offset of one half at the poles).
std::vector<Vec3> fibonacci_directions(std::size_t count);

} // namespace geometry
} // namespace foam
