#include "mjcf_joints.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>

namespace foam::xml_models {
namespace {

/// Returns whether the joint has a range: MuJoCo ignores an empty one, and refuses one upside down.
bool has_range(const Joint& joint) {
    const bool ranged = joint.kind == Joint::Kind::revolute || joint.kind == Joint::Kind::prismatic;
    return ranged && joint.limited && joint.lower < joint.upper;
}

/// Returns the effort, N or N m; 0 if there is no limit.
double effort_of(const Joint& joint) {
    return joint.effort && *joint.effort > 0 ? *joint.effort : 0; // URDF files state 0 for what they do not know
}

std::string range_text(const char* name, const Joint& joint) {
    return has_range(joint) ? attribute_text(name, numbers_text(std::array{joint.lower, joint.upper})) : "";
}

std::string symmetric_text(const char* name, double limit) {
    return limit > 0 ? attribute_text(name, numbers_text(std::array{-limit, limit})) : "";
}

/// Returns an attribute of what the robot states of losses; nothing for zero, and with a warning for less.
std::string loss_text(const char* name, const std::optional<double>& loss, const Joint& joint, Context& context) {
    if (loss && *loss < 0) {
        context.log(Severity::warning,
                    fmt::format("joint '{}' has a negative {}, {}, which feeds it with energy: left out; remedy: a "
                                "number that is not negative",
                                shown(joint.name), name, number_text(*loss)));
    }
    return loss && *loss > 0 ? attribute_text(name, number_text(*loss)) : "";
}

/// The gain of a servo.
struct Gain {
    double value = 0;
    bool stated = false; ///< whether the joint has what it is made of
};

/// The fastest that a servo moves what hangs on it, rad/s: two fifths of a radian in a step of 2 ms, MuJoCo's own.
/// Light fingers with strong motors are unstable above.
constexpr double fastest = 200;

/// Returns the stiffness with which the joint reaches its effort at an error of a fiftieth of its range, or of a turn.
Gain stiffness_of(const DrivenJoint& driven) {
    constexpr double share = 0.02, usual = 100; // N m/rad or N/m
    const Joint& joint = *driven.joint;
    const double span = has_range(joint) ? joint.upper - joint.lower : 2 * std::numbers::pi;
    const double effort = effort_of(joint), most = fastest * fastest * driven.inertia;
    return {std::min(effort > 0 ? effort / (share * span) : usual, most), effort > 0};
}

/// Returns the gain with which the joint reaches its effort at an error as large as its greatest velocity.
Gain velocity_gain_of(const DrivenJoint& driven) {
    constexpr double usual = 10; // N m s/rad or N s/m
    const double effort = effort_of(*driven.joint), velocity = driven.joint->velocity.value_or(0);
    const bool stated = effort > 0 && velocity > 0;
    return {std::min(stated ? effort / velocity : usual, fastest * driven.inertia), stated};
}

} // namespace

std::set<std::string> links_below(const Robot& robot, const std::string& base) {
    std::set<std::string> links{base};
    std::vector<std::string> next{base};
    while (!next.empty()) {
        const std::string link = next.back();
        next.pop_back();
        for (const Joint& joint : robot.joints) {
            if (joint.parent == link && links.insert(joint.child).second) {
                next.push_back(joint.child);
            }
        }
    }
    return links;
}

Actuators actuators_named(const std::string& word) {
    return word == "position"   ? Actuators::position
           : word == "velocity" ? Actuators::velocity
           : word == "motor"    ? Actuators::motor
                                : Actuators::none;
}

std::string joint_text(const Joint& joint, Context& context) {
    if (joint.kind == Joint::Kind::planar || joint.kind == Joint::Kind::floating) {
        throw Error(ErrorCode::output,
                    fmt::format("write.mjcf: joint '{}' is {}, which MJCF has not within a robot; "
                                "remedy: a fixed or revolute joint",
                                joint.name, joint.kind == Joint::Kind::planar ? "planar" : "floating"));
    }
    std::string text = "<joint" + attribute_text("name", joint.name);
    text += joint.kind == Joint::Kind::prismatic ? attribute_text("type", "slide") : "";
    text += attribute_text("axis", vector_text(joint.axis));
    text += range_text("range", joint);
    text += symmetric_text("actuatorfrcrange", effort_of(joint));
    text += loss_text("damping", joint.damping, joint, context);
    text += loss_text("frictionloss", joint.friction, joint, context);
    return text + "/>";
}

std::string equality_text(const SphereModel& model) {
    const Kinematics kinematics(model.robot);
    std::string text;
    for (std::size_t i = 0; i < model.robot->joints.size(); ++i) {
        const JointMotion& motion = kinematics.motions()[i];
        const std::string& name = model.robot->joints[i].name;
        if (!motion.freedom || kinematics.freedoms()[*motion.freedom].joint == name) {
            continue;
        }
        const std::string& other = kinematics.freedoms()[*motion.freedom].joint;
        if (!model.facts.lock_joints.contains(other)) {
            text +=
                "    <joint" + attribute_text("joint1", name) + attribute_text("joint2", other) +
                attribute_text("polycoef", numbers_text(std::array{motion.offset, motion.multiplier, 0.0, 0.0, 0.0})) +
                "/>\n";
        }
    }
    return text.empty() ? "" : "  <equality>\n" + text + "  </equality>\n";
}

std::string actuator_text(const std::vector<DrivenJoint>& joints, Actuators kind, Context& context) {
    std::string text;
    std::vector<std::string> unknown;
    for (const DrivenJoint& driven : joints) {
        const Joint* joint = driven.joint;
        const std::string names = attribute_text("name", joint->name) + attribute_text("joint", joint->name);
        const std::string force = symmetric_text("forcerange", effort_of(*joint));
        if (kind == Actuators::motor) {
            text += "    <motor" + names + symmetric_text("ctrlrange", effort_of(*joint)) + "/>\n";
            continue;
        }
        const bool position = kind == Actuators::position;
        const Gain gain = position ? stiffness_of(driven) : velocity_gain_of(driven);
        if (!gain.stated) {
            unknown.push_back(shown(joint->name));
        }
        text += position ? "    <position" + names + attribute_text("kp", number_text(gain.value)) +
                               attribute_text("dampratio", "1") + range_text("ctrlrange", *joint)
                         : "    <velocity" + names + attribute_text("kv", number_text(gain.value)) +
                               symmetric_text("ctrlrange", joint->velocity.value_or(0));
        text += force + "/>\n";
    }
    if (!unknown.empty()) {
        context.log(Severity::warning,
                    fmt::format("the gain of the actuators of {} is a guess: the robot states no {}; remedy: <limit "
                                "effort=\"…\" velocity=\"…\"/>",
                                fmt::join(unknown, ", "),
                                kind == Actuators::position ? "effort" : "effort or no velocity"));
    }
    return text.empty() ? "" : "  <actuator>\n" + text + "  </actuator>\n";
}

} // namespace foam::xml_models
