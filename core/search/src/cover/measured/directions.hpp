// Directions spread evenly, padded to whole vectors.
#pragma once

#include "cover/measured/points.hpp"

namespace foam::inline search::cover {

/// Returns `count` unit vectors on the Fibonacci lattice, rotated by `turn`, so that different sets see different
/// directions.
Points spread_directions(std::size_t count, std::uint64_t turn);

} // namespace foam::search::cover
