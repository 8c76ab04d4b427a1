// Balls inside the solid, for the guarantee `inner`.
#pragma once

#include "columns.hpp"

#include <foam/geometry/solid.hpp>
#include <foam/sdk/context.hpp>

#include <span>
#include <vector>

namespace foam::medial {

/// Returns at most `count` balls inside the solid about some of the centres, each as large as possible. One after
/// another the ball with most points of a lattice that no ball contains yet (greedy maximum coverage; Nemhauser, Wolsey
/// and Fisher 1978: at least 1 - 1/e of the maximum). Local frame. Empty if no centre is inside.
std::vector<Sphere> inner_balls(const Solid& solid, const Frame& frame, const Columns& columns,
                                std::span<const Sphere> centers, std::size_t count, Context& context);

} // namespace foam::medial
