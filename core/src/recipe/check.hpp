// From a tree of values to a checked Recipe, part by part. Each function reads one key of the recipe and adds findings.
#pragma once

#include "edit.hpp"
#include "typed.hpp"

namespace foam::reading {

/// What the checks share.
struct Checking {
    const Registry& registry;
    Findings& findings;
};

/// The whole recipe. Plugins have been loaded. `suffix` is appended to its name.
Recipe check_recipe(const Value& root, const std::filesystem::path& file, const std::string& suffix,
                    const Checking& checking);

/// One stage as it stands in lists: "repair.watertight" or {repair.watertight: {leaves: 1000}}.
struct StageItem {
    StageCall call;
    const RegisteredStage* stage = nullptr; ///< nullptr after a finding
    Key name;
    const Value* parameters = nullptr; ///< nullptr: none given
};
/// `list`: the key it stands under. Parameters are not read.
StageItem read_stage_item(const Value& item, std::string_view list, const Checking& checking);
/// Reads the parameters of a known stage into its call. `other_keys` are allowed beside them.
void read_stage_parameters(StageItem& item, const std::vector<std::string>& other_keys, const Checking& checking);
/// The keys isolate, time_limit and memory_limit of a map. `owner`: the stage; empty: the recipe.
Isolation read_isolation(const Value& map, std::string_view owner, Findings& findings);
/// A finding for each limit in `map` if `effective`, which holds what is merged into it, is no process of its own.
void refuse_idle_limits(const Value& map, const Isolation& effective, std::string_view owner, Findings& findings);
/// The same for a stage; `base`: what its own isolation is merged into, before what the stage wishes.
void refuse_idle_limits(const StageItem& item, const Isolation& base, Findings& findings);
/// The finding for a stage name nobody knows.
void report_unknown_stage(const Key& name, const Checking& checking);

void check_stages(const Value* stages, const Value& root, Recipe& recipe, const Checking& checking);
void check_loaders(const Value& loaders, Recipe& recipe, const Checking& checking);
void check_links(const Value& links, Recipe& recipe, const Checking& checking);
void check_outputs(const Value* outputs, const Value& root, Recipe& recipe, const Checking& checking);
/// Values of joints by name: rad or m.
JointValues read_pose(const Value& value, Findings& findings);
void check_snapshots(const Value* snapshots, const Value& root, Recipe& recipe, const Checking& checking);

/// Whether it is a map with the keys of a recipe; else a finding.
bool expect_recipe(const Value& root, Findings& findings);
/// The key `foam`.
void check_version(const Value& root, Findings& findings);

/// Why `name` cannot name a folder; empty if it can.
std::string why_no_folder_name(std::string_view name);

} // namespace foam::reading
