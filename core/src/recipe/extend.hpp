// extends: a recipe laid over another one.
#pragma once

#include "value.hpp"

#include <foam/host/recipe.hpp>

#include <filesystem>
#include <vector>

namespace foam::reading {

/// The tree of `file`, laid over those that it extends, with the plugins of all loaded and `set` applied. Maps are
/// merged key by key, at all depths; everything else is replaced, and null takes a key away. The names of variants, the
/// stage of `renderer` and `name` are no maps to be merged: a variant and a renderer are replaced as a whole, a name is
/// never inherited. `files`: what was read, nearest first. False after a finding that leaves nothing to check.
bool complete_tree(Value& root, const std::filesystem::path& file, Registry& registry, std::vector<RecipeFile>& files,
                   Findings& findings);

/// Loads the plugins that the tree names.
void load_plugins(const Value& root, const std::filesystem::path& file, Registry& registry, Findings& findings);

/// Texts as read_texts() gives them, that name files. A relative one is relative to the file in which it stands, which
/// may be one that the recipe extends: it becomes relative to the recipe.
std::vector<std::string> read_references(const Value& value, std::string_view name, Findings& findings);

} // namespace foam::reading
