// Points that balls left outside, taken back in.
#pragma once

#include "cover/points.hpp"

#include <cstdint>
#include <vector>

namespace foam::cover {

/// A point and the ball that is to hold it.
struct Held {
    float x, y, z;
    float force; ///< how far the ball has come towards it
    std::uint32_t owner, point;
};

/// The least change of the balls by which each holds its points: the projection onto linearised constraints by
/// Hildreth's method (1957), force by force, for some sweeps. Those that press in the first sweep are gone over again
/// and again, the others once more at the end: put those first that are likely to press, and most of the others find
/// themselves held. `held` is reordered; `pressed[point]` says of its points which press in the end.
void take_in(std::vector<Held>& held, Balls& balls, std::vector<char>& pressed);

} // namespace foam::cover
