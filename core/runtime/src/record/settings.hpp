// The settings of a recipe that can change an output.
#pragma once

#include <foam/recipe/recipe.hpp>

#include <nlohmann/json.hpp>

namespace foam::inline runtime {

/// Returns name, seed, stages with all parameters that affect their output, budget, guarantee, overrides, outputs. Not
/// the places of inputs (their digests are compared), nor pictures and files for people.
nlohmann::ordered_json settings_of(const Recipe& recipe, const Registry& registry);

} // namespace foam::runtime
