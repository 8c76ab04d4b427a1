// The price of one ball in place of two.
#pragma once

#include "cover/measured/occupancy.hpp"

namespace foam::inline search::cover {

/// Returns the volume of a ball less that of the union of two, both outside other balls and outside a solid, units³. It
/// is a sum over a lattice of some hundred cells, to compare pairs by; OutsideVolume is finer, and for many evaluations
/// at one place.
double added_volume(const Ball& merged, const Ball& a, const Ball& b, const Balls& others, const Occupancy& occupancy);

} // namespace foam::inline search::cover
