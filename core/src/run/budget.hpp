// How many spheres each group gets.
#pragma once

#include "shapes.hpp"

#include <vector>

namespace foam {

/// The count of every group (0 for those with an error), by the recipe's budget; ShapeWork::trees then holds a tree of
/// that count. What the budget asks for and cannot have is a finding. Throws Error(recipe) for a budget below the least
/// that the groups need, and for an excess of geometry without volume.
std::vector<std::size_t> choose_counts(const Workspace& workspace, const std::vector<LinkWork>& links,
                                       std::vector<ShapeWork>& shapes, const std::vector<Group>& groups);

/// The counts that choose_counts() asks of a shape before it knows anything; 0: no budget. `groups`: of the robot.
std::vector<std::size_t> first_counts(const Recipe& recipe, const ShapeWork& shape, std::size_t groups);

} // namespace foam
