// Reading and schema of the keys of `robot` beside `urdf`.
#pragma once

#include <foam/recipe/recipe.hpp>
#include <foam/yaml/value.hpp>

#include <nlohmann/json.hpp>

namespace foam::inline recipe::reading {

void check_facts(const yaml::Value& robot, Recipe& recipe, yaml::Findings& findings);
/// Returns the schema of each key, by name.
nlohmann::ordered_json schema_of_facts();

} // namespace foam::inline recipe::reading
