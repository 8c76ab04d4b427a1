// The joints between two links, as seen from one link on the way.
#pragma once

#include <foam/host/kinematics.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace foam::self_collision {

/// The way through the tree from one link to another; indices into robot.links.
struct Way {
    std::vector<std::size_t> up;   ///< from the first link, itself included, to below `meeting`
    std::vector<std::size_t> down; ///< from below `meeting` to the last link, itself included
    std::size_t meeting = 0;       ///< the lowest link that is above both, or one of them
};
Way way_between(const Kinematics& kinematics, std::size_t from, std::size_t to);

/// Joined by at most one joint that moves, with no link in between that has geometry (one flag a link of the robot).
bool adjacent(const Kinematics& kinematics, const std::vector<bool>& has_geometry, std::size_t first,
              std::size_t second);

/// A joint on the way, walked in either direction.
struct Step {
    Pose before; ///< from the end of the step before it to the joint's frame
    const Joint* joint = nullptr;
    double sign = 1; ///< -1: walked from child to parent
    JointMotion motion;
};

/// A serial chain: before₁ · motion₁ · before₂ · motion₂ ⋯ end.
struct Chain {
    std::vector<Step> steps; ///< of joints that some freedom moves
    Pose end;
    bool unbounded = false; ///< a planar or floating joint lies on the way
};

/// From link to link, indices into robot.links.
Chain chain_between(const Kinematics& kinematics, std::size_t from, std::size_t to);

/// Where a step's joint is, in the frame that the chain starts from.
struct Axis {
    Vec3 origin, direction; ///< direction: unit
};

/// Pose of the chain's end, and into `axes`, one for each step, where its joints are.
Pose forward(const Chain& chain, std::span<const double> configuration, std::span<Axis> axes);

/// The chain read as two that start in the frame before step `cut`: one to each end.
struct SplitChain {
    Chain first, second;
};
SplitChain split(const Chain& chain, std::size_t cut);

} // namespace foam::self_collision
