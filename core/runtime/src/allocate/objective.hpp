// The objectives of spherizers, and their figures.
#pragma once

#include <foam/geometry/objective.hpp>
#include <foam/recipe/recipe.hpp>
#include <foam/sdk/registry.hpp>

#include <optional>
#include <vector>

namespace foam::inline runtime {

/// Returns the objective of a call of a spherizer, from its StageInfo::objective_parameter; nothing if it is not one of
/// foam's objectives.
std::optional<Objective> objective_of(const StageCall& spherizer, const Registry& registry);

/// Returns the figure that the objective minimises, of the spheres grown to cover the solid: the excess volume, m³, the
/// largest protrusion, m, or the largest radius, m.
double figure_of(const Solid& solid, const std::vector<Sphere>& spheres, Objective objective);
/// Returns the same for elements of any kind; their size is the radius of the smallest sphere around each.
double figure_of(const Solid& solid, const Elements& elements, Objective objective);

} // namespace foam::runtime
