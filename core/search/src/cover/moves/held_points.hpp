// Restoration of points that balls left outside.
#pragma once

#include "cover/measured/points.hpp"

#include <cstdint>
#include <vector>

namespace foam::inline search::cover {

/// A point and the ball that should contain it.
struct Held {
    float x, y, z;
    float force; ///< how far the ball moved towards it
    std::uint32_t owner, point;
};

/// Applies the least change of the balls by which each contains its points: the projection onto linearised constraints
/// by Hildreth's method (1957), force by force, for some sweeps. Points active in the first sweep are visited again in
/// every sweep, the others once more at the end: if likely active points come first, most of the others are already
/// contained. `held` is reordered; `pressed[point]` marks the points that are active in the end.
void take_in(std::vector<Held>& held, Balls& balls, std::vector<char>& pressed);

} // namespace foam::search::cover
