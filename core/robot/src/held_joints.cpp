#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/robot/held_joints.hpp>
#include <foam/robot/kinematics.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace foam::inline robot {
namespace {

std::string why_unknown(const Robot& robot, const std::string& name) {
    std::vector<std::string> joints;
    for (const Joint& joint : robot.joints) {
        joints.push_back(joint.name);
    }
    const std::string near = nearest_word(name, joints);
    return fmt::format("{} has no joint '{}'{}",
                       shown(robot.file.empty() ? robot.name : robot.file.filename().string()), shown(name),
                       near.empty() ? "" : fmt::format("; did you mean '{}'?", shown(near)));
}

/// Returns why a joint of the robot cannot be held anywhere; empty if it can.
std::string why_immovable(const Joint& joint) {
    switch (joint.kind) {
    case Joint::Kind::fixed:
        return fmt::format("joint '{}' is fixed: it does not move", shown(joint.name));
    case Joint::Kind::planar:
    case Joint::Kind::floating:
        return fmt::format("joint '{}' has several freedoms, and is held at none", shown(joint.name));
    case Joint::Kind::revolute:
    case Joint::Kind::continuous:
    case Joint::Kind::prismatic:
        break;
    }
    return joint.mimic ? fmt::format("joint '{}' follows joint '{}'; remedy: hold that one", shown(joint.name),
                                     shown(joint.mimic->joint))
                       : "";
}

} // namespace

std::string why_not_held(const Robot& robot, const std::string& name, double position) {
    const auto joint = std::find_if(robot.joints.begin(), robot.joints.end(),
                                    [&](const Joint& candidate) { return candidate.name == name; });
    if (joint == robot.joints.end()) {
        return why_unknown(robot, name);
    }
    if (std::string why = why_immovable(*joint); !why.empty() || !std::isfinite(position)) {
        return why.empty() ? fmt::format("joint '{}' is to be held at a finite position", shown(name)) : why;
    }
    const bool limited = joint->kind != Joint::Kind::continuous && joint->limited && joint->lower <= joint->upper;
    if (limited && (position < joint->lower || position > joint->upper)) {
        return fmt::format("joint '{}' moves from {} to {} {}, and {} is outside", shown(name),
                           number_text(joint->lower), number_text(joint->upper),
                           joint->kind == Joint::Kind::prismatic ? "m" : "rad", number_text(position));
    }
    return "";
}

Robot with_joints_held(Robot robot, const JointValues& held) {
    for (const auto& [joint, position] : held) {
        if (const std::string why = why_not_held(robot, joint, position); !why.empty()) {
            throw Error(ErrorCode::usage, why);
        }
    }
    if (held.empty()) {
        return robot;
    }
    const Kinematics kinematics(std::make_shared<const Robot>(robot));
    const std::vector<double> values = kinematics.joint_values(kinematics.configuration(held));
    for (std::size_t i = 0; i < robot.joints.size(); ++i) {
        Joint& joint = robot.joints[i];
        const std::optional<std::size_t> freedom = kinematics.motions()[i].freedom;
        if (freedom && held.contains(kinematics.freedoms()[*freedom].joint)) {
            joint.origin = joint.origin * joint_motion(joint, values[i]);
            joint.kind = Joint::Kind::fixed;
            joint.mimic.reset();
        }
    }
    return robot;
}

} // namespace foam::inline robot
