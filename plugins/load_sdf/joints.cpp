#include "joints.hpp"

#include "shapes.hpp"

#include <sdf/JointAxis.hh>

#include <fmt/format.h>

#include <cmath>

namespace foam::load_sdf {
namespace {

/// SDF writes a joint without limit as ±1e16.
bool is_limit(double value) {
    return std::abs(value) < 1e15;
}

std::optional<double> stated(double value) {
    return value > 0 && is_limit(value) ? std::optional(value) : std::nullopt;
}

/// Returns what an axis states; its kind is revolute, or prismatic if it slides.
Joint joint_about(const ::sdf::Joint& source, unsigned int index, bool slides, const std::string& child,
                  const Document& document) {
    const ::sdf::JointAxis* axis = source.Axis(index);
    const char* name = index == 0 ? "axis" : "axis2";
    if (!axis) {
        document.fail(source.Element(),
                      fmt::format("joint '{}' has no <{}>; remedy: <{}><xyz>0 0 1</xyz></{}>", source.Name(), name,
                                  name, name));
    }
    ignition::math::Vector3d direction;
    document.require_none(axis->ResolveXyz(direction, child));
    Joint joint;
    joint.axis = normalized({direction.X(), direction.Y(), direction.Z()});
    if (joint.axis == Vec3{}) {
        document.fail(source.Element(), fmt::format("the <{}> of joint '{}' has no direction; remedy: one that is not 0",
                                                    name, source.Name()));
    }
    joint.limited = is_limit(axis->Lower()) && is_limit(axis->Upper());
    // One limit alone does not bound an angle: every direction can be reached.
    joint.kind = !slides         ? (joint.limited ? Joint::Kind::revolute : Joint::Kind::continuous)
                 : joint.limited ? Joint::Kind::prismatic
                                 : Joint::Kind::floating;
    if (joint.limited) {
        joint.lower = axis->Lower();
        joint.upper = axis->Upper();
    }
    joint.effort = stated(axis->Effort());
    joint.velocity = stated(axis->MaxVelocity());
    joint.damping = stated(axis->Damping());
    joint.friction = stated(axis->Friction());
    return joint;
}

Joint plain(Joint::Kind kind) {
    Joint joint;
    joint.kind = kind;
    joint.limited = false;
    return joint;
}

/// Returns whether the joint turns about a line that misses the child's origin.
bool misses_origin(const Joint& joint, const Vec3& anchor) {
    constexpr double rounding = 1e-12; // m; libsdformat multiplies poses
    const bool turns = joint.kind == Joint::Kind::revolute || joint.kind == Joint::Kind::continuous;
    return turns && norm(cross(joint.axis, anchor)) > rounding;
}

} // namespace

Motion motion_of(const ::sdf::Joint& joint, const std::string& child, const Document& document) {
    using Type = ::sdf::JointType;
    Motion motion;
    const auto about = [&](unsigned int index, bool slides) {
        motion.joints.push_back(joint_about(joint, index, slides, child, document));
    };
    switch (joint.Type()) {
    case Type::REVOLUTE2:
    case Type::UNIVERSAL:
        about(0, false);
        about(1, false);
        break;
    case Type::REVOLUTE:
        about(0, false);
        break;
    case Type::CONTINUOUS:
        about(0, false);
        motion.joints.front().kind = Joint::Kind::continuous;
        motion.joints.front().limited = false;
        break;
    case Type::PRISMATIC:
        about(0, true);
        break;
    case Type::BALL:
    case Type::SCREW:
        motion.joints.push_back(plain(Joint::Kind::floating));
        break;
    case Type::FIXED:
        motion.joints.push_back(plain(Joint::Kind::fixed));
        break;
    case Type::GEARBOX:
    case Type::INVALID:
        document.fail(joint.Element(), fmt::format("joint '{}' connects no links", joint.Name()));
    }
    motion.simplified = motion.joints.front().kind == Joint::Kind::floating;
    ignition::math::Pose3d pose;
    document.require_none(joint.SemanticPose().Resolve(pose, child));
    const Vec3 anchor = pose_of(pose).translation;
    for (const Joint& one : motion.joints) {
        if (misses_origin(one, anchor)) {
            motion.anchor = anchor;
        }
    }
    return motion;
}

} // namespace foam::load_sdf
