// What every search of covers begins and ends with.
#pragma once

#include "cover/points.hpp"

#include <foam/host/spherize.hpp>

namespace foam::cover {

/// The smallest ball around the surface, in the unit frame.
Ball smallest_ball(const Solid& solid, const Frame& frame);

/// Balls of the unit frame as spheres, a hair larger, with the proof that they hold the surface; grown where they do
/// not.
Cover proved(const Solid& solid, const Frame& frame, const Balls& balls);

} // namespace foam::cover
