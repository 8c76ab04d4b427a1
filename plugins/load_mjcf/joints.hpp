// Joints of MJCF in the words of foam::Robot.
#pragma once

#include "model.hpp"

#include <foam/robot/robot.hpp>

namespace foam::mjcf {

/// A joint of a body, in the frame of that body.
struct BodyJoint {
    Joint joint; ///< without links; its origin holds the turn or the way of `ref` alone
    Vec3 anchor; ///< the point about which it turns
    bool has_anchor = false;
};

/// Returns a <joint> or <freejoint>. `frame`: that of the <frame> elements around it. A ball, and a slide without a
/// range, become floating: no joint of a Robot is a ball, and a way without an end has no limits.
BodyJoint joint_of(const Node& node, const Attributes& attributes, const Settings& settings, const Pose& frame);

} // namespace foam::mjcf
