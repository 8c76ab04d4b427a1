// Recipes that come with foam, by name.
#pragma once

#include <filesystem>
#include <string>

namespace foam::cli {

/// Describes the argument that recipe_file() takes.
inline constexpr const char* recipe_help =
    "The recipe, a YAML file; or the name of one that comes with foam: panda_22; "
    "- is the standard input";

/// Returns the recipe's file: `name` itself, or, if that is a word and no file, the recipe of that name that comes with
/// foam. Throws Error(usage) if there is neither.
std::filesystem::path recipe_file(const std::string& name);

} // namespace foam::cli
