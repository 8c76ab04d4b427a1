// A URDF for a robot that has no text of its own: a single mesh, or a robot that a program made.
#pragma once

#include <foam/robot/robot.hpp>

#include <string>

namespace foam {

/// Returns all that the robot has as URDF: links with inertias, visuals and collision geometry, joints with limits,
/// dynamics and mimics. Numbers keep all digits, angles up to rounding.
std::string composed_urdf(const Robot& robot);

} // namespace foam
