// Whether two links touch in all configurations, in none, or in some.
#pragma once

#include "ball_group.hpp"
#include "chain.hpp"

#include <atomic>
#include <cstddef>

namespace foam::self_collision {

enum class Verdict {
    never,   ///< proved
    always,  ///< proved
    some,    ///< seen both touching and apart
    unknown, ///< out of boxes
};

/// Branch and bound over boxes of the values of the joints in between. In the middle of a box the distance between the
/// links' spheres is computed; within the box no centre moves further than a bound that the joints' half ranges and
/// the centre's distances from their axes give (displacement bound as in Schwarzer, Saha, Latombe: Adaptive dynamic
/// collision checking for single and multiple articulated robots, IEEE T-RO 2005). A box whose distance exceeds what
/// both may move is apart throughout; one with an overlap deeper than that touches throughout; any other is halved.
Verdict touching_verdict(const Kinematics& kinematics, const Chain& chain, const BallGroup& first,
                         const BallGroup& second, std::size_t boxes, const std::atomic<bool>* cancel);

} // namespace foam::self_collision
