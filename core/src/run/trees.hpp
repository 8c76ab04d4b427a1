// The sphere trees of a shape: what its spherizer says, checked, and what the guarantee and the recipe make of that.
#pragma once

#include "shapes.hpp"

#include <vector>

namespace foam {

/// What the cache knows the tree of a shape by, of at most `count` spheres; 0: no budget.
Digest tree_key(const Workspace& workspace, const ShapeWork& work, std::size_t count);

/// Trees for the counts that are asked for, from the cache or the stage; what the stage returns is checked. Count 0
/// stands for "no budget".
void compute_trees(const Workspace& workspace, ShapeWork& work, const std::vector<std::size_t>& counts);

} // namespace foam
