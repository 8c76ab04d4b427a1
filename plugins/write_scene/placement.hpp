// Rotations as messages and scenes have them.
#pragma once

#include <foam/geometry/vector.hpp>

#include <array>

namespace foam::scene {

/// Returns the rotation as a unit quaternion x, y, z, w, with w >= 0.
std::array<double, 4> message_quaternion(const Pose& pose);

} // namespace foam::scene
