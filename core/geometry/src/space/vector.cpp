#include <foam/geometry/vector.hpp>

#include <cmath>
#include <numbers>

namespace foam::inline geometry {

Pose Pose::operator*(const Pose& other) const {
    Pose result;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            double sum = 0;
            for (int k = 0; k < 3; ++k) {
                sum += rotation[static_cast<std::size_t>(row)][k] * other.rotation[static_cast<std::size_t>(k)][column];
            }
            result.rotation[static_cast<std::size_t>(row)][column] = sum;
        }
    }
    result.translation = *this * other.translation;
    return result;
}

Pose Pose::inverse() const {
    Pose result;
    const auto& r = rotation;
    result.rotation = {Vec3{r[0].x, r[1].x, r[2].x}, Vec3{r[0].y, r[1].y, r[2].y}, Vec3{r[0].z, r[1].z, r[2].z}};
    result.translation = -result.rotate(translation);
    return result;
}

Pose Pose::from_xyz_rpy(const Vec3& xyz, const Vec3& rpy) {
    const double cr = std::cos(rpy.x), sr = std::sin(rpy.x);
    const double cp = std::cos(rpy.y), sp = std::sin(rpy.y);
    const double cy = std::cos(rpy.z), sy = std::sin(rpy.z);
    Pose pose;
    pose.rotation = {Vec3{cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr},
                     Vec3{sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr}, Vec3{-sp, cp * sr, cp * cr}};
    pose.translation = xyz;
    return pose;
}

Pose Pose::from_axis_angle(const Vec3& axis, double angle) {
    const double c = std::cos(angle), s = std::sin(angle), t = 1 - c;
    const auto [x, y, z] = axis;
    Pose pose;
    pose.rotation = {Vec3{t * x * x + c, t * x * y - s * z, t * x * z + s * y},
                     Vec3{t * x * y + s * z, t * y * y + c, t * y * z - s * x},
                     Vec3{t * x * z - s * y, t * y * z + s * x, t * z * z + c}};
    return pose;
}

std::array<double, 4> quaternion(const Pose& pose) {
    const auto& m = pose.rotation;
    const double trace = m[0].x + m[1].y + m[2].z;
    std::array<double, 4> q{};
    if (trace > 0) {
        const double s = 2 * std::sqrt(1 + trace);
        q = {s / 4, (m[2].y - m[1].z) / s, (m[0].z - m[2].x) / s, (m[1].x - m[0].y) / s};
    } else if (m[0].x >= m[1].y && m[0].x >= m[2].z) {
        const double s = 2 * std::sqrt(1 + m[0].x - m[1].y - m[2].z);
        q = {(m[2].y - m[1].z) / s, s / 4, (m[0].y + m[1].x) / s, (m[0].z + m[2].x) / s};
    } else if (m[1].y >= m[2].z) {
        const double s = 2 * std::sqrt(1 + m[1].y - m[0].x - m[2].z);
        q = {(m[0].z - m[2].x) / s, (m[0].y + m[1].x) / s, s / 4, (m[1].z + m[2].y) / s};
    } else {
        const double s = 2 * std::sqrt(1 + m[2].z - m[0].x - m[1].y);
        q = {(m[1].x - m[0].y) / s, (m[0].z + m[2].x) / s, (m[1].z + m[2].y) / s, s / 4};
    }
    if (q[0] < 0) {
        for (double& value : q) {
            value = -value;
        }
    }
    return q;
}

Pose from_quaternion(const Vec3& translation, const std::array<double, 4>& wxyz) {
    auto [w, x, y, z] = wxyz;
    const double length = std::sqrt(w * w + x * x + y * y + z * z);
    w /= length, x /= length, y /= length, z /= length;
    Pose pose;
    pose.rotation = {Vec3{w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
                     Vec3{2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
                     Vec3{2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}};
    pose.translation = translation;
    return pose;
}

Vec3 roll_pitch_yaw(const Pose& pose) {
    const auto& m = pose.rotation;
    // R = Rz(yaw) Ry(pitch) Rx(roll). Where the pitch is a right angle, any yaw goes with one roll: that of Rz(-yaw) R.
    const double yaw = std::atan2(m[1].x, m[0].x), s = std::sin(yaw), c = std::cos(yaw);
    return {std::atan2(s * m[0].z - c * m[1].z, c * m[1].y - s * m[0].y),
            std::atan2(0 - m[2].x, c * m[0].x + s * m[1].x), yaw};
}

Vec3 short_roll_pitch_yaw(const Pose& pose) {
    const Vec3 angles = roll_pitch_yaw(pose);
    for (const double scale : {1e6, 1e9, 1e12}) {
        const auto rounded = [&](double angle) { return std::round(angle * scale) / scale + 0.0; }; // never -0
        const Vec3 few{rounded(angles.x), rounded(angles.y), rounded(angles.z)};
        if (Pose::from_xyz_rpy({}, few).rotation == pose.rotation) {
            return few;
        }
    }
    return angles;
}

std::vector<Vec3> fibonacci_directions(std::size_t count) {
    const double turn = std::numbers::pi * (3 - std::sqrt(5.0)); // the golden angle
    std::vector<Vec3> directions;
    directions.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(count);
        const double across = std::sqrt(std::max(0.0, 1 - z * z));
        const double angle = turn * static_cast<double>(i);
        directions.push_back({across * std::cos(angle), across * std::sin(angle), z});
    }
    return directions;
}

} // namespace foam::inline geometry
