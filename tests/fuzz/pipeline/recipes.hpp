// Random recipes: every stage that is registered, every key.
#pragma once

#include "dice.hpp"

#include <foam/recipe/recipe.hpp>

namespace foam::fuzz {

/// What a recipe is for.
struct RecipeInput {
    std::string file; ///< beside the recipe
    bool robot = false;
    bool elements = false;                         ///< of any kind, instead of spheres
    std::vector<std::string> links, moving_joints; ///< of a robot
};

/// The text of a recipe that `foam check` finds nothing wrong with. Amounts of work that only cost time (points, cells,
/// spheres) stay small; all other parameters take any value that their declaration allows. A seed keeps its meaning, as
/// far as that goes, when stages and parameters are added: each has a choice of its own.
std::string random_recipe(std::uint64_t seed, const Registry& registry, const RecipeInput& input);

} // namespace foam::fuzz
