// The first and the last step of every search for covering balls.
#pragma once

#include "cover/measured/points.hpp"

#include <foam/search/spherize.hpp>

namespace foam::inline search::cover {

/// Returns the smallest ball around the surface, in the unit frame.
Ball smallest_ball(const Solid& solid, const Frame& frame);

/// Returns balls of the unit frame as slightly larger spheres. Balls of a search contain their parts to some
/// millionths; with the overlap the proof needs no growth.
std::vector<Sphere> with_a_hair_of_overlap(const Frame& frame, const Balls& balls);

/// Returns balls of the unit frame as slightly larger spheres, with the proof that they cover the surface. They are
/// grown if they do not.
Cover proved(const Solid& solid, const Frame& frame, const Balls& balls);

} // namespace foam::search::cover
