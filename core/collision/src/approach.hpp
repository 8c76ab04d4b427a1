// A search for configurations in which two links touch.
#pragma once

#include "ball_group.hpp"

#include <foam/robot/internal/chain.hpp>

#include <cstdint>

namespace foam::inline collision::self_collision {

/// Returns whether a configuration was found in which the elements of the two links touch. From the nearest of some random
/// configurations, the search moves one joint at a time as long as the links come nearer, by smaller and smaller steps
/// (Hooke, Jeeves: "Direct search" solution of numerical and statistical problems, JACM 8, 1961). It finds contacts in
/// far smaller parts of the joints' ranges than random samples do; that it finds none is no proof. Precondition: the
/// chain is bounded.
bool touch_somewhere(const Kinematics& kinematics, const joint_chain::Chain& chain, const BallGroup& first,
                     const BallGroup& second, std::uint64_t seed);

} // namespace foam::inline collision::self_collision
