// For methods whose result may be worse with more spheres.
#pragma once

#include <foam/geometry/solid.hpp>
#include <foam/sdk/stage.hpp>

#include <functional>
#include <span>
#include <vector>

namespace foam::medial {

/// Makes trees for several budgets at once.
using Maker = std::function<std::vector<SphereTree>(std::span<const Budget>)>;

/// Returns the numbers of spheres to compare for a budget of `most`, ascending, `most` itself last.
using Counts = std::function<std::vector<std::size_t>(std::size_t most)>;

/// Returns 1 to 12, then 16, 24, 32, 48…, up to `most`: along these numbers more spheres never have more excess volume.
std::vector<std::size_t> many_fewer(std::size_t most);
/// Returns one sphere too, where only a few are requested: around a ring, two or three have more excess volume than
/// one.
std::vector<std::size_t> one_or_all(std::size_t most);

/// Returns for each budget the tree with the least excess volume once grown to cover, among the counts to compare. The
/// tree of a budget without a number is taken unchanged.
std::vector<SphereTree> best_with_at_most(const Solid& solid, std::span<const Budget> budgets, const Counts& counts,
                                          const Maker& make);

} // namespace foam::medial
