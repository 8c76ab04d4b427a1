// Where the links of a model stand.
#pragma once

#include <foam/sdk/model.hpp>

#include <array>
#include <map>
#include <string>

namespace foam::scene {

/// Returns the poses of the links at the robot's default pose, in the root link's frame; nothing for a model without
/// joints, whose links stand at the origin.
std::map<std::string, Pose> placed_links(const SphereModel& model);

/// Returns the rotation as a unit quaternion x, y, z, w, with w >= 0.
std::array<double, 4> quaternion(const Pose& pose);

} // namespace foam::scene
