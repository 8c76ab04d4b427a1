#include "joints.hpp"

#include <foam/robot/kinematics.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace foam::mjcf {
namespace {

/// Sets the limits. Returns whether the joint has them.
bool read_limits(Joint& joint, const Attributes& attributes, const Settings& settings, double unit) {
    const std::vector<double> range = attributes.numbers("range", 2, 2);
    const bool ranged = !range.empty() && (range[0] != 0 || range[1] != 0);
    if (!attributes.flag("limited", ranged && settings.autolimits, ranged && settings.autolimits)) {
        return false;
    }
    if (range.empty() || range[0] >= range[1]) {
        attributes.fail("range", "the first number of a range is below the second");
    }
    joint.lower = range[0] * unit;
    joint.upper = range[1] * unit;
    return true;
}

void read_dynamics(Joint& joint, const Attributes& attributes) {
    const std::vector<double> damping = attributes.numbers("damping", 1, 3);
    if (!damping.empty()) {
        joint.damping = damping.front();
    }
    joint.friction = attributes.number("frictionloss");
    const std::vector<double> force = attributes.numbers("actuatorfrcrange", 2, 2);
    if (!force.empty()) {
        joint.effort = std::max(std::abs(force[0]), std::abs(force[1]));
    }
}

} // namespace

BodyJoint joint_of(const Node& node, const Attributes& attributes, const Settings& settings, const Pose& frame) {
    BodyJoint result;
    Joint& joint = result.joint;
    joint.line = node.element->line;
    joint.limited = false;
    joint.kind = Joint::Kind::floating;
    const std::string type = node.name() == "freejoint" ? "free" : attributes.word("type", "hinge");
    if (type == "free") {
        return result;
    }
    if (type != "ball" && type != "hinge" && type != "slide") {
        attributes.fail("type", "it is none of free, ball, slide, hinge");
    }
    result.has_anchor = type != "slide";
    result.anchor = frame * attributes.vector("pos").value_or(Vec3{});
    if (type == "ball") {
        return result;
    }
    const Vec3 axis = frame.rotate(attributes.vector("axis").value_or(Vec3{0, 0, 1}));
    if (norm(axis) < 1e-14) {
        attributes.fail("axis", "the axis has no direction; remedy: one that is not 0");
    }
    joint.axis = normalized(axis);
    const bool hinge = type == "hinge";
    const double unit = hinge && settings.degrees ? std::numbers::pi / 180 : 1;
    joint.limited = read_limits(joint, attributes, settings, unit);
    read_dynamics(joint, attributes);
    if (!hinge && !joint.limited) {
        return result;
    }
    joint.kind = !hinge ? Joint::Kind::prismatic : joint.limited ? Joint::Kind::revolute : Joint::Kind::continuous;
    const double reference = attributes.number("ref").value_or(0) * unit;
    joint.origin = reference == 0 ? Pose{} : joint_motion(joint, -reference);
    return result;
}

} // namespace foam::mjcf
