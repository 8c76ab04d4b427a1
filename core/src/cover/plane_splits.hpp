// Balls divided in two by planes, one after another.
#pragma once

#include "cover/limits.hpp"

namespace foam::cover {

/// Balls about the points, `count` of them if there are enough points: until then the ball whose split saves most
/// volume gives way to the smallest balls of the two parts that a plane makes of its points. `balls`: to begin with; if
/// none, the smallest ball of all. Those that are made keep to the limits where they can.
Balls divided(const Points& points, Balls balls, std::size_t count, const Limits& limits = {});

} // namespace foam::cover
