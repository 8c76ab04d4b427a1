// A robot as motion planners see it: for writers of their formats.
#pragma once

#include <foam/sdk/model.hpp>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] sdk {

/// The joints of a robot that move and mimic no other, in the order of the URDF.
struct PlannedJoints {
    /// Joint and position, rad or m.
    using Positions = std::vector<std::pair<std::string, double>>;
    Positions active; ///< those that a planner moves, with their default position
    Positions locked; ///< those that it holds (RobotFacts::lock_joints)
};

/// Returns the joints. Throws Error(output) for a lock_joints or default_pose of a joint that does not move or that
/// mimics another. Precondition: the model has a robot.
PlannedJoints planned_joints(const SphereModel& model);

/// Returns the poses of the links at the robot's default pose, in the root link's frame; nothing for a model without
/// joints, whose links stand at the origin.
std::map<std::string, Pose> placed_links(const SphereModel& model);

/// Returns whether only the names of links are known: the robot has neither joints nor geometry.
bool has_only_names(const Robot& robot);
/// Throws Error(output) if the model has no robot but the names of links. `writer`: its name, for the message.
void require_robot(const SphereModel& model, const std::string& writer);
/// Returns RobotFacts::base_link, or the root link. Throws Error(output) for a link that the robot does not have.
const std::string& base_link(const SphereModel& model);
/// Returns RobotFacts::tool_frames. Throws Error(output) if there is none, or the robot does not have it.
const std::vector<std::string>& require_tool_frames(const SphereModel& model, const std::string& writer);

} // namespace sdk
} // namespace foam
