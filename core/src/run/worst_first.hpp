// Sharing a number of spheres where the worst of them counts.
#pragma once

#include "exploration.hpp"

#include <optional>

namespace foam {

/// The objective that all shapes' spherizers have, if it is one of which the worst sphere of the robot counts:
/// how far it protrudes, or how large it is. None beside limits of protrusion, which come first.
std::optional<Objective> common_objective(const Recipe& recipe, const std::vector<ShapeWork>& shapes);

/// Explores counts as far as they may help the group that is worst by the objective; what cut it is returned.
/// `figures`: of each shape, m, by the counts that its curve knows.
using Figures = std::vector<std::map<std::size_t, double>>;
Cut explore_worst_first(const Workspace& workspace, std::vector<ShapeWork>& shapes, const std::vector<Group>& groups,
                        Objective objective, std::size_t most, Figures& figures);

/// For each taker the fewest spheres with which all of them together, at most `most`, are as good by the objective as
/// they can be: the worst figure is the least. Empty if there are not enough for all.
std::vector<Bounds> bounds_of_best_worst(const std::vector<ShapeWork>& shapes, const std::vector<Group>& groups,
                                         const Figures& figures, std::size_t most);

} // namespace foam
