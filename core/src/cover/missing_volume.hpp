// What balls leave out of a solid.
#pragma once

#include "cover/occupancy.hpp"

namespace foam::cover {

/// Of the solid's volume what no ball holds, units³, in whole cells. Solid::missing_volume() tells it more finely.
double missing_volume(const Occupancy& occupancy, const Balls& balls);

} // namespace foam::cover
