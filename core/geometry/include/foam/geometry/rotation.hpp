// Rotations as files state them: quaternions and angles.
#pragma once

#include <foam/geometry/vector.hpp>

#include <array>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

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

} // namespace geometry
} // namespace foam
