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

/// The numbers of spheres to compare for a budget of `most`, ascending, `most` itself last.
using Counts = std::function<std::vector<std::size_t>(std::size_t most)>;

/// 1 to 12, then 16, 24, 32, 48… as far as these are fewer: along these numbers more spheres never claim more.
std::vector<std::size_t> many_fewer(std::size_t most);
/// One sphere, where only a few are asked for: around a ring, two or three claim more than one.
std::vector<std::size_t> one_or_all(std::size_t most);

/// For each budget the tree that claims least once grown to cover, of those with the numbers to compare. A budget
/// without a number is taken as it is.
std::vector<SphereTree> best_with_at_most(const Solid& solid, std::span<const Budget> budgets, const Counts& counts,
                                          const Maker& make);

} // namespace foam::medial
