// The check of a tree of values, part by part, which makes a Recipe. Each function reads one key and adds findings.
#pragma once

#include <foam/recipe/internal/yaml.hpp>

namespace foam {
inline namespace [[gnu::visibility("default")]] recipe {
namespace reading {

/// The shared state of the checks.
struct Checking {
    const Registry& registry;
    Findings& findings;
};

/// Checks the whole recipe. Precondition: plugins have been loaded. `suffix` is appended to its name.
Recipe check_recipe(const Value& root, const std::filesystem::path& file, const std::string& suffix,
                    const Checking& checking);

/// A stage as lists write it: "repair.watertight" or {repair.watertight: {leaves: 1000}}.
struct StageItem {
    StageCall call;
    const RegisteredStage* stage = nullptr; ///< nullptr after a finding
    Key name;
    const Value* parameters = nullptr; ///< nullptr: none
};
/// Reads a stage without its parameters. `list`: the key of its list.
StageItem read_stage_item(const Value& item, std::string_view list, const Checking& checking);
/// Reads the parameters of a known stage into its call. `other_keys` are allowed in addition.
void read_stage_parameters(StageItem& item, const std::vector<std::string>& other_keys, const Checking& checking);
/// Reads the keys isolate, time_limit and memory_limit of a map. `owner`: the stage; empty: the recipe.
Isolation read_isolation(const Value& map, std::string_view owner, Findings& findings);
/// Adds a finding for each limit in `map` that has no effect, because `effective`, into which the map is merged, does
/// not isolate the stage.
void refuse_idle_limits(const Value& map, const Isolation& effective, std::string_view owner, Findings& findings);
/// Does the same for a stage. `base`: the isolation that its own is merged into, before the stage's wish.
void refuse_idle_limits(const StageItem& item, const Isolation& base, Findings& findings);
/// Refuses an objective with guarantee: fitted, where it has no effect.
void refuse_idle_objective(const StageItem& item, const Recipe& recipe, Findings& findings);
/// Adds the finding for an unknown stage name.
void report_unknown_stage(const Key& name, const Checking& checking);

void check_stages(const Value* stages, const Value& root, Recipe& recipe, const Checking& checking);
void check_loaders(const Value& loaders, Recipe& recipe, const Checking& checking);
void check_links(const Value& links, Recipe& recipe, const Checking& checking);
void check_outputs(const Value* outputs, const Value& root, Recipe& recipe, const Checking& checking);
/// Reads values of joints by name: rad or m.
JointValues read_pose(const Value& value, Findings& findings, const std::string& name = "pose");
void check_snapshots(const Value* snapshots, const Value& root, Recipe& recipe, const Checking& checking);

/// Returns whether the value is a map with the keys of a recipe; otherwise adds a finding.
bool expect_recipe(const Value& root, Findings& findings);
/// Checks the key `foam`.
void check_version(const Value& root, Findings& findings);

/// Returns why `name` cannot name a folder; empty if it can.
std::string why_no_folder_name(std::string_view name);

} // namespace reading
} // namespace recipe
} // namespace foam
