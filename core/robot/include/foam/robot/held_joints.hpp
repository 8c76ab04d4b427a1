// Joints that stand still, such as the fingers of a gripper.
#pragma once

#include <foam/robot/robot.hpp>

#include <string>

namespace foam {
inline namespace [[gnu::visibility("default")]] robot {

/// Returns why the joint cannot be held at this position (rad or m), with the remedy; empty if it can. It must be a
/// joint of one freedom that mimics no other, and the position must be within its limits.
std::string why_not_held(const Robot& robot, const std::string& joint, double position);

/// Returns the robot with these joints fixed where they are held, and with them those that mimic them. The source text
/// stays as it is. Throws Error(usage) for a joint that cannot be held.
Robot with_joints_held(Robot robot, const JointValues& held);

} // namespace robot
} // namespace foam
