// For methods that may do worse with more spheres.
#pragma once

#include <foam/solid.hpp>
#include <foam/stage.hpp>

#include <functional>
#include <span>
#include <vector>

namespace foam::medial {

/// Trees for several budgets at once.
using Maker = std::function<std::vector<SphereTree>(std::span<const Budget>)>;

/// For each budget the tree that claims least once grown to cover: of the one with max_spheres and those with 1 to 12,
/// then 16, 24, 32, 48…, as far as these are fewer. Along these numbers more spheres never claim more. A budget without
/// a number is taken as it is.
std::vector<SphereTree> best_with_at_most(const Solid& solid, std::span<const Budget> budgets, const Maker& make);

} // namespace foam::medial
