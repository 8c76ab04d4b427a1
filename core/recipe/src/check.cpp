#include <foam/recipe/internal/check.hpp>

#include "format.hpp"
#include "plain_length.hpp"

#include <foam/base/file.hpp>
#include <foam/recipe/internal/keys.hpp>
#include <foam/recipe/internal/yaml.hpp>
#include <foam/sdk/kinds.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace foam::inline recipe::reading {
namespace {

bool is_safe(char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || c == '-' ||
           c == '.' || c == '+' || c == '=';
}

/// Returns the recipe's file name without its extension, with the characters of a folder name only.
std::string default_name(const std::filesystem::path& file) {
    std::string name = file.stem().string().substr(0, 100);
    std::replace_if(
        name.begin(), name.end(), [](char c) { return !is_safe(c); }, '_');
    name.erase(0, std::min(name.find_first_not_of(".-"), name.size()));
    return name.empty() ? "recipe" : name;
}

/// Explains keys that are one level deeper than people often write them.
/// Returns where keys belong that are not at the top level.
std::map<std::string, std::string> homes_of_keys() {
    std::map<std::string, std::string> homes{{"urdf", "robot: {urdf: …}"},
                                             {"pose", "snapshots: {pose: …}"},
                                             {"size", "snapshots: {size: …}"},
                                             {"renderer", "snapshots: {renderer: …}"}};
    const auto add = [&](const std::vector<Parameter>& keys, std::string_view home) {
        for (const Parameter& key : keys) {
            const char* example = key.type == Parameter::Type::boolean ? "true" : "…";
            homes.emplace(key.name, fmt::format(fmt::runtime(home), fmt::format("{}: {}", key.name, example)));
        }
    };
    add(declarations_of(budget_keys()), "budget: {{{}}}");
    add(declarations_of(link_keys()), "links: {{…: {{{}}}}}");
    add(declarations_of(debug_keys()), "debug: {{{}}}");
    return homes;
}

void refuse_unknown_top_level_keys(const Value& root, const Checking& checking) {
    const std::map<std::string, std::string> homes = homes_of_keys();
    std::vector<std::string> known = top_level_structures();
    for (const Parameter& p : declarations_of(top_level_keys())) {
        known.push_back(p.name);
    }
    for (const Parameter& p : isolation_values()) {
        known.push_back(p.name);
    }
    Value rest;
    rest.kind = Value::Kind::map;
    for (const Key& key : root.keys) {
        const bool is_known = std::find(known.begin(), known.end(), key.text) != known.end();
        if (const auto home = homes.find(key.text); home != homes.end() && !is_known) {
            checking.findings.error(key.where, "unknown-key",
                                    fmt::format("{} does not belong at the top level; remedy: write {}",
                                                in_quotes(key.text), home->second));
        } else if (checking.registry.find(key.text)) {
            checking.findings.error(key.where, "unknown-key",
                                    fmt::format("stage {} does not belong at the top level; remedy: write it as an "
                                                "item of 'stages' (or of 'outputs', if it writes)",
                                                in_quotes(key.text)));
        } else {
            rest.keys.push_back(key);
        }
    }
    refuse_unknown_keys(rest, "", known, checking.findings);
}

void check_name(const Value& root, const std::filesystem::path& file, const std::string& suffix, const Value* given,
                Recipe& recipe, Findings& findings) {
    if (!given) {
        recipe.name = default_name(file);
    } else if (const std::string why = why_no_folder_name(recipe.name); given->is(Value::Kind::text) && !why.empty()) {
        findings.error(given->where, "bad-name",
                       fmt::format("'name' is the name of the run's folder; {} {}", in_quotes(recipe.name), why));
    }
    recipe.name += suffix;
    if (const std::string why = why_no_folder_name(recipe.name);
        !suffix.empty() && !why.empty() && !findings.any_error()) {
        findings.error(root.where, "bad-name",
                       fmt::format("variant and sweep make the name {}, which {}", in_quotes(recipe.name), why));
    }
}

/// Reads a seed above the largest integer of a stage: the seed is any 64-bit number.
bool read_large_seed(const Value& value, std::uint64_t& seed) {
    const char* end = value.text.data() + value.text.size();
    const auto [stop, error] = std::from_chars(value.text.data(), end, seed);
    return value.is(Value::Kind::number) && error == std::errc() && stop == end;
}

void check_plain_values(const Value& root, Recipe& recipe, Findings& findings) {
    for (const KeyOf<Recipe>& key : top_level_keys()) {
        const std::string& name = key.declared.name;
        const Value* value = root.find(name);
        if (!value || (name == "seed" && read_large_seed(*value, recipe.seed))) {
            continue;
        }
        if (const auto read = read_value(*value, key.declared, "", findings)) {
            key.set(recipe, *read);
        }
    }
}

/// Reads a map of keys with plain values.
void check_values(const Value& map, const std::string& name, const char* example,
                  const std::vector<KeyOf<Recipe>>& keys, Recipe& recipe, Findings& findings,
                  const std::vector<std::string>& other_keys = {}) {
    if (!expect_map(map, name, example, findings)) {
        return;
    }
    const auto values = read_values(map, declarations_of(keys), name, other_keys, findings);
    for (const KeyOf<Recipe>& key : keys) {
        if (const auto it = values.find(key.declared.name); it != values.end()) {
            key.set(recipe, it->second);
        }
    }
}

void check_budget(const Value& budget, Recipe& recipe, Findings& findings) {
    check_values(budget, "budget", "budget: {spheres: 22}", budget_keys(), recipe, findings, {"costs"});
    if (!budget.is(Value::Kind::map)) {
        return;
    }
    static constexpr const char* numbers[] = {"spheres", "elements", "cost"};
    const Key* first = nullptr;
    for (const char* number : numbers) {
        const Key* key = budget.find_key(number);
        if (key && first) {
            findings.error(key->where, "conflict",
                           fmt::format("both '{}' and '{}' limit the elements; remedy: delete one", first->text,
                                       key->text));
        }
        first = first ? first : key;
    }
    if (const Value* costs = budget.find("costs")) {
        check_values(*costs, "costs", "costs: {sphere: 1, capsule: 2}", cost_keys(), recipe, findings);
        if (!recipe.budget_cost && !budget.find("cost")) {
            findings.error(budget.find_key("costs")->where, "conflict",
                           "'costs' has no effect without a limit; remedy: budget: {cost: 40, costs: …}, or delete it");
        }
    }
}

/// Reads the arguments of a xacro file, a map from names to values, as a parameter of its loader.
void check_xacro_arguments(const Value& args, Recipe& recipe, Findings& findings) {
    if (!expect_map(args, "args", "args: {NAME: VALUE}", findings)) {
        return;
    }
    std::string text;
    for (std::size_t i = 0; i < args.keys.size(); ++i) {
        if (args.items[i].is(Value::Kind::map) || args.items[i].is(Value::Kind::list)) {
            findings.error(args.items[i].where, "wrong-type",
                           fmt::format("'{}' of args expects a text or a number, got {}", args.keys[i].text,
                                       args.items[i].description()));
            continue;
        }
        text += args.keys[i].text + ":=" + args.items[i].text + "\n";
    }
    recipe.loaders.push_back({"load.xacro", {{"args", text}}, {}});
}

void check_robot_files(const Value& robot, Recipe& recipe, Findings& findings) {
    const Value* urdf = robot.find("urdf");
    const Value* xacro = robot.find("xacro");
    const Value* args = robot.find("args");
    if (!urdf && !xacro) {
        findings.error(robot.where, "missing-key", "'robot' needs 'urdf'; remedy: write robot: {urdf: FILE}");
    } else if (urdf && xacro) {
        findings.error(robot.find_key("xacro")->where, "conflict",
                       "both 'urdf' and 'xacro' are given; remedy: delete one");
    } else {
        recipe.urdf = read_references(urdf ? *urdf : *xacro, urdf ? "urdf" : "xacro", findings);
    }
    for (const std::string& file : recipe.urdf) { // the ending tells that xacro has to run
        if (xacro && !urdf && extension_of(file) != "xacro") {
            findings.error(xacro->where, "wrong-format",
                           fmt::format("'{}' does not end in .xacro; remedy: rename it, or write robot: {{urdf: FILE}} "
                                       "if it is a URDF",
                                       file));
        }
    }
    if (args && !xacro) {
        findings.error(robot.find_key("args")->where, "conflict",
                       "'args' are arguments of a xacro file; remedy: delete them, or write robot: {xacro: FILE}");
    } else if (args) {
        check_xacro_arguments(*args, recipe, findings);
    }
}

void check_input(const Value& root, Recipe& recipe, Findings& findings) {
    const Value* robot = root.find("robot");
    const Value* mesh = root.find("mesh");
    if (!robot && !mesh) {
        findings.error({root.where.source, 1, 1}, "missing-key",
                       "there is no input; remedy: write 'robot: {urdf: FILE}' or 'mesh: FILE'");
        return;
    }
    const Key& key = *root.find_key(robot ? "robot" : "mesh");
    recipe.input_where = findings.locate(key.where);
    if (robot && mesh) {
        const Key& other = *root.find_key("mesh");
        const char* inherited = other.where.source != key.where.source ? ", by null if it is of an extended file" : "";
        findings.error(other.where, "conflict",
                       fmt::format("both 'robot' and 'mesh' are given; remedy: delete one{}", inherited));
    }
    if (mesh) {
        recipe.mesh = read_references(*mesh, "mesh", findings);
    }
    if (robot && expect_map(*robot, "robot", "robot: {urdf: FILE}", findings)) {
        std::vector<std::string> known{"urdf", "xacro", "args"};
        for (const FactKey& fact : fact_keys()) {
            known.push_back(fact.name);
        }
        refuse_unknown_keys(*robot, "robot", known, findings);
        check_facts(*robot, recipe, findings);
        check_robot_files(*robot, recipe, findings);
    }
}

/// Checks that unit and scale are used for a single mesh whose file has no unit.
void check_unit(const Value& root, const Recipe& recipe, const Checking& checking) {
    const Key* key = root.find_key("unit") ? root.find_key("unit") : root.find_key("scale");
    const bool robot = !recipe.urdf.empty();
    for (const std::string& input : robot ? recipe.urdf : recipe.mesh) {
        const InputKind kind = robot ? InputKind::robot : InputKind::mesh;
        if (const std::string why = why_refused(recipe.mesh_unit, input, kind, checking.registry, recipe.preferred_loader);
            key && !why.empty()) {
            checking.findings.error(key->where, "conflict", why);
            return;
        }
    }
}

void check_self_collision(const Value& value, const Value& root, Recipe& recipe, Findings& findings) {
    if (value.is(Value::Kind::boolean)) {
        recipe.self_collision = value.flag;
    } else if (value.is(Value::Kind::map)) {
        recipe.self_collision = true;
        refuse_unknown_keys(value, "self_collision", {"pose"}, findings);
        if (const Value* pose = value.find("pose")) {
            recipe.self_collision_pose = read_pose(*pose, findings);
            recipe.self_collision_where = findings.locate(pose->where);
        }
    } else {
        findings.error(value.where, "wrong-type",
                       fmt::format("'self_collision' expects true, false or a map, got {}; remedy: write "
                                   "self_collision: true, or {{pose: {{joint: 0.5}}}}",
                                   value.description()));
    }
    if (recipe.self_collision && root.find("mesh")) {
        findings.error(root.find_key("self_collision")->where, "conflict",
                       "'self_collision' concerns the links of a robot: it has no effect on a mesh; remedy: delete it");
    }
}

/// Refuses keys that need spheres outside the geometry.
void refuse_outer_keys(const Value& root, const Recipe& recipe, Findings& findings) {
    if (recipe.guarantee != Guarantee::inner) {
        return;
    }
    if (recipe.budget_max_protrusion) {
        findings.error(root.find("budget")->find_key("max_protrusion")->where, "conflict",
                       "spheres inside the geometry do not protrude: 'max_protrusion' has no effect with guarantee: "
                       "inner; remedy: give 'spheres' instead");
    }
    if (recipe.budget_excess) {
        findings.error(root.find("budget")->find_key("excess")->where, "conflict",
                       "spheres inside the geometry have no excess: 'excess' has no effect with guarantee: inner; "
                       "remedy: give 'spheres' instead");
    }
    if (recipe.on_error == OnError::fallback) {
        findings.error(root.find_key("on_error")->where, "conflict",
                       "a bounding sphere cannot replace a link with guarantee: inner; remedy: on_error: stop or skip");
    }
}

/// Refuses guarantee: inner for elements of other kinds than sphere.
void refuse_inner_elements(const Value& root, const Recipe& recipe, const Checking& checking) {
    const RegisteredStage* stage = checking.registry.find(recipe.spherizer.stage);
    if (recipe.guarantee == Guarantee::inner && stage && !spheres_alone(stage->info.kinds)) {
        checking.findings.error(root.find_key("guarantee")->where, "conflict",
                                fmt::format("only spheres are proved to lie inside the geometry, {} makes {}; remedy: "
                                            "guarantee: outer or fitted, or spherize.cover",
                                            in_quotes(recipe.spherizer.stage), words_of(stage->info.kinds)));
    }
}

/// Refuses `budget: {for: poses}` where it has no effect, or contradicts another key.
void check_budget_for(const Value& root, const Recipe& recipe, Findings& findings) {
    if (recipe.budget_for != BudgetFor::poses) {
        return;
    }
    const Place where = root.find("budget")->find_key("for")->where;
    const auto refuse = [&](const char* why) { findings.error(where, "conflict", why); };
    if (root.find("mesh")) {
        refuse("'for: poses' needs a robot: a mesh has no poses; remedy: delete it");
    }
    if (recipe.guarantee != Guarantee::outer) {
        refuse(
            "'for: poses' is about elements that extend beyond the geometry, of guarantee: outer; remedy: delete it");
    }
    if (recipe.budget_excess) {
        refuse("'for: poses' distributes a budget, and 'excess' takes as few elements as it needs; remedy: delete one "
               "of them");
    } else if (!recipe.budget_spheres && !recipe.budget_cost) {
        refuse("'for: poses' is a rule of the allocation of elements: it has no effect without budget: {spheres: …}, "
               "{elements: …} or {cost: …}; remedy: give one of them, or delete it");
    }
    if (recipe.self_collision) {
        refuse("'for: poses' and 'self_collision' are two rules for the same budget; remedy: delete one of them");
    }
}

/// Refuses keys without effect on this input or this guarantee.
void refuse_idle_keys(const Value& root, const Recipe& recipe, Findings& findings) {
    if (const Key* cover = root.find_key("cover"); cover && root.find("mesh")) {
        findings.error(cover->where, "conflict",
                       "'cover' selects geometry of a robot: it has no effect on a mesh; remedy: delete it");
    }
    if (const Key* pad = root.find_key("pad"); pad && recipe.guarantee == Guarantee::inner) {
        findings.error(pad->where, "conflict",
                       "'pad' may put spheres outside the geometry, which guarantee: inner does not allow; remedy: "
                       "delete it, or guarantee: outer");
    }
    if (recipe.budget_share && !recipe.budget_spheres && !recipe.budget_cost && !recipe.budget_excess) {
        findings.error(root.find("budget")->find_key("share")->where, "conflict",
                       "'share' is a rule of the allocation of spheres: it has no effect without budget: {spheres: …} "
                       "or {excess: …}; remedy: give one of them, or delete it");
    }
    check_budget_for(root, recipe, findings);
}

} // namespace

bool expect_recipe(const Value& root, Findings& findings) {
    if (!root.is(Value::Kind::map)) {
        const bool empty = root.is(Value::Kind::null);
        findings.error({root.where.source, std::max(root.where.line, 1), std::max(root.where.column, 1)},
                       empty ? "empty" : "wrong-type",
                       fmt::format("{}; remedy: begin with 'foam: 1', then 'robot' and 'stages'",
                                   empty ? "the recipe is empty" : "a recipe is a map, got " + root.description()));
    }
    if (const Key* experiment = root.find_key("foam_experiment")) {
        findings.error(experiment->where, "wrong-format",
                       "this is an experiment, not a recipe; remedy: run it by `foam bench`");
        return false;
    }
    return root.is(Value::Kind::map);
}

void check_version(const Value& root, Findings& findings) {
    const Value* version = root.find("foam");
    if (!version) {
        findings.error(
            {root.where.source, 1, 1}, "missing-key",
            fmt::format("the version of the recipe format is missing; remedy: begin with 'foam: {}'", format_version));
    } else if (!version->is(Value::Kind::integer) || version->whole != format_version) {
        findings.error(
            version->where, "version",
            fmt::format("this foam reads recipe format {}, the recipe says {}; remedy: write 'foam: {}' and run "
                        "`foam check`",
                        format_version, version->description(), format_version));
    }
}

std::string why_no_folder_name(std::string_view name) {
    if (name.empty()) {
        return "is empty";
    }
    if (name.front() == '.' || name.front() == '-') {
        return fmt::format("begins with '{}'", name.front());
    }
    if (!std::all_of(name.begin(), name.end(), is_safe)) {
        return "holds other characters than letters, digits, _ - + = and .";
    }
    return name.size() > 200 ? "is longer than 200 characters" : "";
}

Recipe check_recipe(const Value& root, const std::filesystem::path& file, const std::string& suffix,
                    const Checking& checking) {
    Recipe recipe;
    Findings& findings = checking.findings;
    recipe.file = file;
    check_version(root, findings);
    refuse_unknown_top_level_keys(root, checking);
    check_plain_values(root, recipe, findings);
    check_name(root, file, suffix, root.find("name"), recipe, findings);
    check_input(root, recipe, findings);
    if (const Value* path = root.find("package_path")) {
        recipe.package_path = read_references(*path, "package_path", findings);
    }
    if (const Value* plugins = root.find("plugins")) {
        recipe.plugins = read_references(*plugins, "plugins", findings);
    }
    if (const Value* budget = root.find("budget")) {
        check_budget(*budget, recipe, findings);
    }
    if (const Value* self_collision = root.find("self_collision")) {
        check_self_collision(*self_collision, root, recipe, findings);
    }
    refuse_outer_keys(root, recipe, findings);
    refuse_idle_keys(root, recipe, findings);
    if (const Value* debug = root.find("debug")) {
        check_values(*debug, "debug", "debug: {meshes: true, snapshots: true}", debug_keys(), recipe, findings);
    }
    recipe.isolation = read_isolation(root, "", findings);
    refuse_idle_limits(root, recipe.isolation, "", findings);
    if (const Value* loaders = root.find("loaders")) {
        check_loaders(*loaders, recipe, checking);
    }
    check_unit(root, recipe, checking);
    check_stages(root.find("stages"), root, recipe, checking);
    refuse_inner_elements(root, recipe, checking);
    if (const Value* links = root.find("links")) {
        check_links(*links, recipe, checking);
    }
    check_outputs(root.find("outputs"), root, recipe, checking);
    check_snapshots(root.find("snapshots"), root, recipe, checking);
    recipe.plain_lengths = plain_lengths(root, checking.registry);
    return recipe;
}

} // namespace foam::recipe::reading
