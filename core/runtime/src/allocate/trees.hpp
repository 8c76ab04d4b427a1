// The sphere trees of a shape: the spherizer's results, checked, and adapted to the guarantee and the recipe.
#pragma once

#include "input/shapes.hpp"

#include <vector>

namespace foam::inline runtime {

/// Returns the cache key of a shape's tree with at most `count` spheres; 0: no budget.
Digest tree_key(const Workspace& workspace, const ShapeWork& work, std::size_t count);

/// Adds the trees for the requested counts, from the cache or the stage, and checks the results of the stage. Count 0
/// means "no budget".
void compute_trees(const Workspace& workspace, ShapeWork& work, const std::vector<std::size_t>& counts);

} // namespace foam::runtime
