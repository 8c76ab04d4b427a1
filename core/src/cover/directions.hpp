// Directions spread evenly, padded to whole vectors.
#pragma once

#include "cover/points.hpp"

namespace foam::cover {

/// `count` unit vectors on the Fibonacci lattice, turned by a rotation that `turn` names, so that what one set of
/// directions overlooks the next one sees.
Points spread_directions(std::size_t count, std::uint64_t turn);

} // namespace foam::cover
