// Balls inside the solid: what the guarantee `inner` asks for.
#pragma once

#include "columns.hpp"

#include <foam/context.hpp>
#include <foam/solid.hpp>

#include <span>
#include <vector>

namespace foam::medial {

/// At most `count` balls inside the solid about some of the centres, each as large as it can be: one after another the
/// one that holds most of what none holds yet, of points of a lattice (greedy maximum coverage; Nemhauser, Wolsey and
/// Fisher 1978: at least 1 - 1/e of the most that could be held). Local frame. Empty if no centre is inside.
std::vector<Sphere> inner_balls(const Solid& solid, const Frame& frame, const Columns& columns,
                                std::span<const Sphere> centers, std::size_t count, Context& context);

} // namespace foam::medial
