// The joints of an MJCF, and what refers to them: couplings and actuators.
#pragma once

#include "mjcf.hpp"

#include <foam/robot/kinematics.hpp>
#include <foam/sdk/context.hpp>
#include <foam/sdk/model.hpp>

#include <set>
#include <string>
#include <vector>

namespace foam::xml_models {

/// Returns the links that a link carries, itself among them.
std::set<std::string> links_below(const Robot& robot, const std::string& base);

/// Returns the <joint> with all that the robot states of it. Throws Error(output) for a planar or floating joint.
std::string joint_text(const Joint& joint, Context& context);

/// Returns the <equality> of joints that mimic others: joint1 = offset + multiplier · joint2.
std::string equality_text(const SphereModel& model);

/// A joint that mimics no other.
struct DrivenJoint {
    const Joint* joint = nullptr;
    double inertia = 0; ///< of all that it moves, in the rest pose: kg m² about its axis, or kg
};

/// Returns the <actuator> of the joints in their order.
std::string actuator_text(const std::vector<DrivenJoint>& joints, Actuators kind, Context& context);

} // namespace foam::xml_models
