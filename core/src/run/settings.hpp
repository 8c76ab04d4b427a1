// What a recipe asks for, as far as it can change an output.
#pragma once

#include <foam/host/recipe.hpp>

#include <nlohmann/json.hpp>

namespace foam {

/// Name, seed, stages with all parameters that affect their output, budget, guarantee, overrides, outputs. Not where
/// inputs lie (their digests are compared), nor what is drawn or written for people to look at.
nlohmann::ordered_json settings_of(const Recipe& recipe, const Registry& registry);

} // namespace foam
