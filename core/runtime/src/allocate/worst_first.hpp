// Allocation of spheres where the worst figure of the robot counts.
#pragma once

#include "allocate/exploration.hpp"

#include <optional>

namespace foam::inline runtime {

/// Returns the common objective of all shapes' spherizers if the worst sphere of the robot decides it: the largest
/// protrusion or the largest radius. Nothing with limits of protrusion, which come first.
std::optional<Objective> common_objective(const Recipe& recipe, const std::vector<ShapeWork>& shapes);

/// Explores counts as far as they may improve the group that is worst by the objective. Returns what ended it early.
/// `figures`: of each shape, m, by the counts that its curve knows.
using Figures = std::vector<std::map<std::size_t, double>>;
Cut explore_worst_first(const Workspace& workspace, std::vector<ShapeWork>& shapes, const std::vector<Group>& groups,
                        Objective objective, std::size_t most, Figures& figures);

/// Returns for each group the fewest spheres such that the worst figure is as small as at most `most` spheres allow.
/// Empty if there are not enough for all.
std::vector<Bounds> bounds_of_best_worst(const std::vector<ShapeWork>& shapes, const std::vector<Group>& groups,
                                         const Figures& figures, std::size_t most);

} // namespace foam::runtime
