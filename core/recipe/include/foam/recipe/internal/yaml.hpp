// Recipes as YAML: read with places, typed, edited, extended.
#pragma once

#include <foam/recipe/recipe.hpp>
#include <foam/sdk/registry.hpp>
#include <foam/yaml/value.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] recipe {
namespace reading {

using namespace yaml;

/// Reads a regular file of at most a megabyte, the limit of check_text(). Returns why it cannot be read, with the
/// remedy; empty if it was read.
std::string read_text(const std::filesystem::path& file, std::string& text);

/// Returns `value` in the declared type, within its bounds; nothing after a finding. An integral number ("1e3") is
/// allowed as an integer, an integer as a number, and a text with a unit ("10mm") as a number of unit m. `owner`:
/// "budget", "simplify.quadric", or empty.
std::optional<ParameterValue> read_value(const Value& value, const Parameter& declared, std::string_view owner,
                                         Findings& findings);

/// Returns the declared keys of a map. Others are findings, unless they are among `other_keys`.
std::map<std::string, ParameterValue> read_values(const Value& map, const std::vector<Parameter>& declared,
                                                  std::string_view owner, const std::vector<std::string>& other_keys,
                                                  Findings& findings);

/// Adds a finding for each unknown key of the map.
void refuse_unknown_keys(const Value& map, std::string_view owner, const std::vector<std::string>& known,
                         Findings& findings);

/// Returns false after a finding if `value` does not have the expected kind. `example`: how to write it.
bool expect_map(const Value& value, std::string_view name, std::string_view example, Findings& findings);
bool expect_list(const Value& value, std::string_view name, std::string_view example, Findings& findings);

/// Reads a text, or a list of at least one text; none of them empty.
std::vector<std::string> read_texts(const Value& value, std::string_view name, Findings& findings);

/// Sets the value at `path` ("budget.spheres", "stages.1.simplify.quadric.ratio", "stages.simplify.quadric.ratio").
/// List items are counted from 0 or named by their stage. Keys may contain dots: existing keys come first, then names
/// of stages. Makes missing maps on the way. A null value removes the key. Returns why it is impossible; empty if it is
/// done.
std::string set_by_path(Value& root, std::string_view path, const Value& value, const Registry& registry);

/// One point of a sweep: the recipe's tree with the values of this point, and a suffix that makes its name unique.
struct SweepPoint {
    Value root;
    std::string suffix; ///< "-spheres=22"; empty without a sweep
};

/// Removes the key `sweep` from the tree and returns all combinations, in the order of the keys, the last one fastest.
std::vector<SweepPoint> expand_sweep(Value root, const Registry& registry, Findings& findings);

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
