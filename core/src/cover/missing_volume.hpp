// What balls leave out of a solid.
#pragma once

#include "cover/occupancy.hpp"
#include "cover/power_cells.hpp"

namespace foam::cover {

/// How many of the points no ball holds; `owners` is overwritten.
std::size_t count_missing(const Points& inside, const Balls& balls, Owners& owners);

/// Of the solid's volume what no ball holds, units³, in whole cells. Solid::missing_volume() tells it more finely.
double missing_volume(const Occupancy& occupancy, const Balls& balls);

} // namespace foam::cover
