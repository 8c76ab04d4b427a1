// The joints of an MJCF, and what refers to them: couplings and actuators.
#pragma once

#include "mjcf.hpp"

#include <foam/robot/kinematics.hpp>
#include <foam/sdk/context.hpp>
#include <foam/sdk/model.hpp>

#include <string>
#include <vector>

namespace foam::xml_models {

/// Returns the <joint> with all that the robot states of it. Throws Error(output) for a planar or floating joint.
std::string joint_text(const Joint& joint, Context& context);

/// Returns the <equality> of joints that mimic others: joint1 = offset + multiplier · joint2.
std::string equality_text(const SphereModel& model);

/// Returns the <actuator> of the joints in their order. Those that mimic others have none.
std::string actuator_text(const std::vector<const Joint*>& joints, Actuators kind, Context& context);

} // namespace foam::xml_models
