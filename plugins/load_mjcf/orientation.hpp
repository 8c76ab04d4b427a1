// Poses of MJCF: a position, and one of five words for an orientation.
#pragma once

#include "attributes.hpp"
#include "model.hpp"

#include <foam/geometry/vector.hpp>

#include <span>

namespace foam::mjcf {

/// Returns the pose that an element states: pos, and quat, axisangle, euler, xyaxes or zaxis. Fails on two of these.
Pose pose_of(const Attributes& attributes, const Settings& settings);
/// Returns the rotation by three angles, in the order of eulerseq.
Pose of_euler(std::span<const double> angles, const Settings& settings);
/// Returns the least rotation that takes z to a direction.
Pose turned_z(const Vec3& direction);

} // namespace foam::mjcf
