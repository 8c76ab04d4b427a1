// The lengths without a unit of a recipe's tree.
#pragma once

#include <foam/recipe/plain_length.hpp>
#include <foam/sdk/registry.hpp>
#include <foam/yaml/value.hpp>

#include <vector>

namespace foam::inline recipe::reading {

/// Returns the lengths without a unit: keys of the recipe, and parameters of its stages.
std::vector<PlainLength> plain_lengths(const yaml::Value& root, const Registry& registry);

} // namespace foam::inline recipe::reading
