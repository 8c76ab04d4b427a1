// Balls divided in two by planes, one after another.
#pragma once

#include "cover/portfolio/limits.hpp"

namespace foam::inline search::cover {

/// Returns balls about the points, `count` of them if there are enough points. Repeatedly, the ball whose split saves
/// most volume is replaced by the smallest balls of the two parts into which a plane cuts its points. `balls`: the
/// start; if empty, the smallest ball around all points. New balls satisfy the limits where they can.
Balls divided(const Points& points, Balls balls, std::size_t count, const Limits& limits = {});

} // namespace foam::search::cover
