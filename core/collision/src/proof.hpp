// The proof that two links touch in all configurations, in none, or in some.
#pragma once

#include "ball_group.hpp"

#include <foam/robot/internal/chain.hpp>

#include <atomic>
#include <cstddef>
#include <vector>

namespace foam::inline collision::self_collision {

using namespace joint_chain;

/// Returns the freedoms that move the chain, sorted. Precondition: its joints move.
std::vector<std::size_t> freedoms_of(const Chain& chain);

enum class Verdict {
    never,   ///< proved
    always,  ///< proved
    some,    ///< observed both touching and apart
    unknown, ///< not decided within the allowed number of boxes
};

/// Decides by branch and bound over boxes of the values of the joints between the links. In the middle of a box it
/// computes the distance between the links' spheres. Within the box no centre moves farther than a bound from the
/// joints' half ranges and the centre's distances from their axes (displacement bound as in Schwarzer, Saha, Latombe:
/// Adaptive dynamic collision checking for single and multiple articulated robots, IEEE T-RO 2005). If the distance
/// exceeds the displacements of both, the links are apart in the whole box. If an overlap is deeper than that, they
/// touch in the whole box. Any other box is halved. The search ends early where the share of the joint positions that is
/// decided after some hundred boxes shows that a proof would take more than `boxes`.
Verdict touching_verdict(const Kinematics& kinematics, const Chain& chain, const BallGroup& first,
                         const BallGroup& second, std::size_t boxes, const std::atomic<bool>* cancel);

} // namespace foam::collision::self_collision
