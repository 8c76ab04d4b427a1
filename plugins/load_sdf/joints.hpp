// Joints of SDF in the words of foam::Robot.
#pragma once

#include "document.hpp"

#include <foam/robot/robot.hpp>

#include <sdf/Joint.hh>

#include <string>
#include <vector>

namespace foam::load_sdf {

/// A joint at rest, in the frame of its child.
struct Motion {
    std::vector<Joint> joints; ///< one after the other, with kind, axis and limits alone; a second one where it has two axes
    Vec3 anchor;               ///< the point about which they turn; the origin where that makes no difference
    bool simplified = false;   ///< it is read as floating, which moves more than it does
};

/// Returns the motion of a joint. `child`: its child link, in the words of the joint's model. A ball, a screw, and a
/// slide without limits, become floating: no joint of a Robot is one.
Motion motion_of(const ::sdf::Joint& joint, const std::string& child, const Document& document);

} // namespace foam::load_sdf
