// The joints between two links, in the frame of a link between them.
#pragma once

#include <foam/robot/kinematics.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] robot {
namespace joint_chain {

/// The path in the tree from one link to another; indices into robot.links.
struct Way {
    std::vector<std::size_t> up;   ///< from the first link, inclusive, to below `meeting`
    std::vector<std::size_t> down; ///< from below `meeting` to the last link, inclusive
    std::size_t meeting = 0;       ///< the lowest common ancestor; it may be one of the two links
};
Way way_between(const Kinematics& kinematics, std::size_t from, std::size_t to);

/// Returns whether at most one movable joint joins the links, with no link with geometry in between. `has_geometry`:
/// one flag per link of the robot.
bool adjacent(const Kinematics& kinematics, const std::vector<bool>& has_geometry, std::size_t first,
              std::size_t second);

/// A joint on the path, in either direction.
struct Step {
    Pose before; ///< from the end of the previous step to the joint's frame
    const Joint* joint = nullptr;
    double sign = 1; ///< -1: from child to parent
    JointMotion motion;
};

/// A serial chain: before₁ · motion₁ · before₂ · motion₂ ⋯ end.
struct Chain {
    std::vector<Step> steps; ///< of movable joints
    Pose end;
    bool unbounded = false; ///< a planar or floating joint is on the path
};

/// Returns the chain from link to link, indices into robot.links.
Chain chain_between(const Kinematics& kinematics, std::size_t from, std::size_t to);

/// The place of a step's joint, in the frame of the chain's start.
struct Axis {
    Vec3 origin, direction; ///< direction: unit
};

/// Returns the pose of the chain's end. Writes the axes of its joints to `axes`, one per step.
Pose forward(const Chain& chain, std::span<const double> configuration, std::span<Axis> axes);

/// The chain split into two that start in the frame before step `cut`, one to each end.
struct SplitChain {
    Chain first, second;
};
SplitChain split(const Chain& chain, std::size_t cut);

} // namespace joint_chain
} // namespace robot
} // namespace foam
