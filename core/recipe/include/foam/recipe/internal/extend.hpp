// extends: a recipe on the basis of another one.
#pragma once

#include <foam/recipe/internal/yaml.hpp>
#include <foam/recipe/recipe.hpp>

#include <filesystem>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] recipe {
namespace reading {

/// Reads the tree of `file`, merges it into those that it extends, loads the plugins of all and applies `set`. Maps are
/// merged key by key, at all depths. Everything else is replaced, and null removes a key. Exceptions: a variant and the
/// stage of `renderer` are replaced as a whole, and `name` is never inherited. `files`: the files that were read,
/// nearest first. Returns false after a finding that leaves nothing to check.
bool complete_tree(Value& root, const std::filesystem::path& file, Registry& registry, std::vector<RecipeFile>& files,
                   Findings& findings);

/// Loads the plugins that the tree names.
void load_plugins(const Value& root, const std::filesystem::path& file, Registry& registry, Findings& findings);

/// Reads names of files, as read_texts() does. A relative one is relative to its file, which may be one that the recipe
/// extends; the result is relative to the recipe.
std::vector<std::string> read_references(const Value& value, std::string_view name, Findings& findings);

} // namespace reading
} // namespace recipe
} // namespace foam
