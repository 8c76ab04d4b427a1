#include <foam/geometry/rotation.hpp>

namespace foam::inline geometry {

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

} // namespace foam::inline geometry
