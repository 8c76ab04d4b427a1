// The volume of a solid outside balls.
#pragma once

#include "by_spheres/measured/occupancy.hpp"
#include "by_spheres/starts/power_cells.hpp"

namespace foam::inline search::by_spheres {

/// Returns how many of the points no ball contains; overwrites `owners`.
std::size_t count_missing(const Points& inside, const Balls& balls, Owners& owners);

/// Returns the missing volume, units³, in whole cells. Solid::missing_volume() is finer.
double missing_volume(const Occupancy& occupancy, const Balls& balls);

} // namespace foam::search::by_spheres
