// What covers are to have least, and how much of it they have.
#pragma once

#include <foam/host/recipe.hpp>
#include <foam/host/registry.hpp>
#include <foam/host/spherize.hpp>

#include <optional>
#include <vector>

namespace foam {

/// What a call of a spherizer aims at, by its StageInfo::objective_parameter; nothing: something that is not known
/// here.
std::optional<Objective> objective_of(const StageCall& spherizer, const Registry& registry);

/// What spheres have of that which is to be least, grown to cover the solid: the volume outside, m³, how far they stick
/// out, m, or the largest radius, m.
double figure_of(const Solid& solid, const std::vector<Sphere>& spheres, Objective objective);

} // namespace foam
