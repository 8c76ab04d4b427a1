// The keys of a recipe that options about a robot stand for.
#pragma once

#include <foam/recipe/robot_choices.hpp>

#include <string>

namespace foam::inline recipe {

/// Returns the keys below `robot`, as YAML; empty if there are none.
std::string robot_keys(const RobotChoices& choices);
/// Returns the key `links`, as YAML; empty if there is none.
std::string links_key(const RobotChoices& choices);

/// Throws Error(usage) if something is chosen of a mesh, which has neither links nor joints. `file`: its name.
void refuse_choices_of_mesh(const RobotChoices& choices, const std::string& file);

/// Returns a text as a JSON string, which is a YAML string. Throws Error(usage) for one that is not UTF-8.
std::string json_string(const std::string& text);

} // namespace foam::inline recipe
