// What the checks of a recipe share: text of values, facts of stages, changes.
#pragma once

#include <foam/recipe/internal/yaml.hpp>
#include <foam/recipe/recipe.hpp>
#include <foam/sdk/parameter.hpp>
#include <foam/yaml/value.hpp>

#include <nlohmann/json.hpp>

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace foam::inline recipe::reading {

/// Version of the format, the value of the key `foam`.
inline constexpr int format_version = 1;
/// The renderer of snapshots when the recipe names none.
inline constexpr const char* default_renderer = "snapshot.osmesa";
/// Bounds on the width and height of pictures, in pixels.
inline constexpr int smallest_picture = 16, largest_picture = 16384;

/// Declarations of keys with a plain value. An empty default means that the key may be absent: see its doc sentence.
std::vector<Parameter> clip_values(); ///< offset, reach; of a plane, in addition to its normal
/// Returns isolate, time_limit, memory_limit: at the top level, and beside the parameters of mesh loaders, mesh filters
/// and spherizers.
std::vector<Parameter> isolation_values();
/// Returns whether a text with a unit ("10mm") is allowed as a number in metres.
bool is_length(const Parameter& parameter);
/// Returns whether the absence of a key differs from every value of it.
bool is_optional(const std::string& key);

/// Returns the keys with a list or map: robot, mesh, stages, …
std::vector<std::string> top_level_structures();

void check_facts(const yaml::Value& robot, Recipe& recipe, yaml::Findings& findings);
/// Returns the schema of each key, by name.
nlohmann::ordered_json schema_of_facts();

struct Change {
    std::string path;
    Value value;
    Place where;        ///< of the path
    std::string remedy; ///< how to end the sweep of the same path
};

/// Reads a map from paths to values. Paths that begin with one of `fixed` are findings and are left out. `by`: "a
/// variant".
std::vector<Change> read_changes(const Value& map, std::string_view by, std::initializer_list<const char*> fixed,
                                 Findings& findings);

/// Applies the changes in their order.
void apply_changes(Value& root, const std::vector<Change>& changes, const Registry& registry, Findings& findings);

/// A named set of changes.
struct Variant {
    std::string name;
    Place where;
    std::vector<Change> changes;
};

/// Removes the key `variants` from the tree and returns its variants.
std::vector<Variant> take_variants(Value& root, Findings& findings);

} // namespace foam::inline recipe::reading
