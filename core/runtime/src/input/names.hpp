// Names of links and joints in recipes, checked against the robot.
#pragma once

#include <foam/recipe/recipe.hpp>

#include <vector>

namespace foam::inline runtime {

/// Returns a finding for each name of the recipe that the robot does not have: an error, but for globs a warning unless
/// the recipe is strict.
std::vector<Diagnostic> unknown_names(const Recipe& recipe, const Robot& robot);
/// Throws Error(recipe) with the errors among the findings, if there are any.
void require_names(const std::vector<Diagnostic>& findings);

} // namespace foam::runtime
