// What every search of covers begins and ends with.
#pragma once

#include "cover/points.hpp"

#include <foam/host/spherize.hpp>

namespace foam::cover {

/// The smallest ball around the surface, in the unit frame.
Ball smallest_ball(const Solid& solid, const Frame& frame);

/// Spheres with the proof that they hold the surface, grown where they do not; Cover::volume is left to the caller.
Cover proved(const Solid& solid, std::vector<Sphere> spheres);

} // namespace foam::cover
