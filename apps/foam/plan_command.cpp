// foam plan: what would run.
#include "cli/files.hpp"
#include "commands.hpp"
#include "execute.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/runtime/plan.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace foam::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct PlanArguments {
    std::string recipe;
    std::vector<std::string> settings, variants;
    bool json = false;
};

std::string files_text(const Recipe& recipe) {
    std::string text = recipe.file.string();
    for (const RecipeFile& base : recipe.extended) {
        text += " < " + base.file.string();
    }
    return recipe.variant.empty() ? text : fmt::format("{}, variant {}", text, recipe.variant);
}

std::string parameters_text(const PlannedStage& stage) {
    std::vector<std::string> parts;
    for (const auto& [name, value] : stage.given) {
        parts.push_back(fmt::format("{}: {}", name, to_text(value)));
    }
    return parts.empty() ? "" : fmt::format(" {{{}}}", fmt::join(parts, ", "));
}

/// Returns the word of budget.share.
const std::string& word_of(Share share) {
    return words_of_share().at(static_cast<std::size_t>(share));
}

std::string budget_text(const Recipe& recipe) {
    std::vector<std::string> parts;
    if (recipe.budget_spheres) {
        parts.push_back(
            fmt::format("{} {}", *recipe.budget_spheres, recipe.budget_in_elements ? "elements" : "spheres"));
    }
    if (recipe.budget_cost) {
        parts.push_back(fmt::format("cost of at most {}", to_text(*recipe.budget_cost)));
    }
    if (recipe.budget_excess) {
        parts.push_back(fmt::format("excess of at most {}", to_text(*recipe.budget_excess)));
    }
    if (recipe.budget_max_protrusion) {
        parts.push_back(fmt::format("protrusion of at most {} m", to_text(*recipe.budget_max_protrusion)));
    }
    if (parts.empty()) {
        parts.emplace_back("determined by the spherizer's parameters");
    }
    if (recipe.budget_time_limit) {
        parts.push_back(fmt::format("the best within {} s", to_text(*recipe.budget_time_limit)));
    }
    if (recipe.budget_share) {
        parts.push_back("share " + word_of(*recipe.budget_share));
    }
    if (recipe.budget_for == BudgetFor::poses) {
        parts.emplace_back("for poses");
    }
    const std::string cover = recipe.cover ? fmt::format("; covers {}", to_string(*recipe.cover)) : "";
    const std::string pad = recipe.pad ? fmt::format("; padding {} m", to_text(*recipe.pad)) : "";
    return fmt::format("{}; guarantee {}{}{}; seed {}", fmt::join(parts, ", "), to_string(recipe.guarantee), cover, pad,
                       recipe.seed);
}

std::string pose_text(const JointValues& values) {
    std::vector<std::string> joints;
    for (const auto& [joint, value] : values) {
        joints.push_back(fmt::format("{} at {}", joint, to_text(value)));
    }
    joints.emplace_back(values.empty() ? "all joints at zero" : "others at zero");
    return fmt::format("spheres of links that are not neighbours, with {}", fmt::join(joints, ", "));
}

std::string places_text(const PlannedLink& link) {
    std::vector<std::string> places;
    for (const LinkOverride& change : link.overrides) {
        places.push_back(fmt::format("{} ({})", change.where.text(), change.glob));
    }
    return fmt::format("{}", fmt::join(places, ", "));
}

std::string cache_text(const PlannedStage& stage) {
    return stage.needed == 0              ? "nothing to do"
           : stage.cached == stage.needed ? "cached"
           : stage.cached == 0            ? "to do"
                                          : fmt::format("{} of {} cached", stage.cached, stage.needed);
}

std::string link_text(const PlannedLink& link) {
    if (link.skipped) {
        return "excluded by " + places_text(link);
    }
    if (!link.error.empty()) {
        return "cannot be read: " + shown_lines(link.error);
    }
    std::vector<std::string> stages;
    for (const PlannedStage& stage : link.stages) {
        stages.push_back(fmt::format("{} {}", stage.stage, cache_text(stage)));
    }
    return fmt::format("{}{}", fmt::join(stages, ", "),
                       link.overrides.empty() ? "" : "; changed by " + places_text(link));
}

/// "10 by load.mesh, 1 by load.assimp".
std::string loaders_text(const Plan& plan) {
    std::map<std::string, std::size_t> counts;
    for (const PlannedFile& mesh : plan.meshes) {
        ++counts[mesh.loader];
    }
    std::vector<std::string> parts;
    for (const auto& [loader, count] : counts) {
        parts.push_back(fmt::format("{} by {}", count, loader));
    }
    return fmt::format("{}", fmt::join(parts, ", "));
}

std::string text_of(const Plan& plan, const Recipe& recipe) {
    const auto plugin = [](const PlannedStage& stage) {
        return fmt::format("{} {}", stage.plugin, stage.plugin_version);
    };
    std::string text = recipe.name + "\n";
    const auto line = [&](const char* key, const std::string& value) {
        text += fmt::format("  {:<10} {}\n", key, value);
    };
    line("recipe", files_text(recipe));
    line("input", fmt::format("{} ({})", plan.input, plan.input_file.file.string()));
    for (const std::string& candidate : plan.not_found) {
        line("", "not found before it: " + candidate);
    }
    if (const std::string loaders = loaders_text(plan); !loaders.empty()) {
        line("meshes", loaders);
    }
    for (const PlannedStage& stage : plan.stages) {
        line(&stage == &plan.stages.front() ? "stages" : "",
             fmt::format("{}{} ({})", stage.stage, parameters_text(stage), plugin(stage)));
    }
    line("budget", budget_text(recipe));
    for (const PlannedLink& link : plan.links) {
        if (link.skipped || !link.error.empty()) {
            continue;
        }
        for (const ClipPlane& plane : recipe.for_link(link.link).clip) {
            line("clip", fmt::format("{}: {}, spheres reach at most {} m beyond it", shown(link.link), text_of(plane),
                                     to_text(plane.reach)));
        }
    }
    if (recipe.self_collision) {
        line("apart", pose_text(recipe.self_collision_pose));
    }
    const std::size_t width = column_width("", plan.links, &PlannedLink::link);
    for (const PlannedLink& link : plan.links) {
        line(&link == &plan.links.front() ? "links" : "",
             fmt::format("{}  {}", padded(link.link, width), link_text(link)));
    }
    for (const PlannedOutput& output : plan.outputs) {
        line(&output == &plan.outputs.front() ? "outputs" : "",
             fmt::format("{} by {} ({})", output.file, output.writer.stage, plugin(output.writer)));
    }
    if (plan.renderer) {
        line("pictures", fmt::format("by {} ({})", plan.renderer->stage, plugin(*plan.renderer)));
    }
    line("directory", (fs::path("runs") / recipe.name).string());
    return text;
}

Json json_of_planned(const PlannedStage& stage, bool with_cache) {
    Json json{{"stage", stage.stage},
              {"plugin", stage.plugin},
              {"plugin_version", stage.plugin_version},
              {"parameters", Json::object()}};
    for (const auto& [name, value] : stage.given) {
        json["parameters"][name] = std::visit([](const auto& v) { return Json(v); }, value);
    }
    if (with_cache) {
        json["cached"] = stage.cached;
        json["needed"] = stage.needed;
    }
    return json;
}

Json json_of_planned(const PlannedFile& file) {
    return {{"file", file.file.string()}, {"digest", file.digest}};
}

Json json_of_planned(const PlannedLink& link) {
    Json json{{"link", link.link},
              {"shapes", link.geometry},
              {"skipped", link.skipped},
              {"overrides", Json::array()},
              {"stages", Json::array()}};
    for (const LinkOverride& change : link.overrides) {
        json["overrides"].push_back({{"glob", change.glob},
                                     {"file", change.where.file},
                                     {"line", change.where.line},
                                     {"column", change.where.column}});
    }
    for (const PlannedStage& stage : link.stages) {
        json["stages"].push_back(json_of_planned(stage, true));
    }
    if (!link.error.empty()) {
        json["error"] = link.error;
    }
    return json;
}

Json json_of_budget(const Recipe& recipe) {
    Json json = Json::object();
    if (recipe.budget_spheres) {
        json[recipe.budget_in_elements ? "elements" : "spheres"] = *recipe.budget_spheres;
    }
    if (recipe.budget_cost) {
        json["cost"] = *recipe.budget_cost;
    }
    if (recipe.budget_excess) {
        json["excess"] = *recipe.budget_excess;
    }
    if (recipe.budget_max_protrusion) {
        json["max_protrusion_m"] = *recipe.budget_max_protrusion;
    }
    if (recipe.budget_share) {
        json["share"] = word_of(*recipe.budget_share);
    }
    if (recipe.budget_for) {
        json["for"] = recipe.budget_for == BudgetFor::poses ? "poses" : "geometry";
    }
    if (recipe.budget_time_limit) {
        json["time_limit_seconds"] = *recipe.budget_time_limit;
    }
    return json;
}

Json json_of_planned(const Plan& plan, const Recipe& recipe) {
    Json json{{"name", recipe.name},
              {"directory", (fs::path("runs") / recipe.name).string()},
              {"recipe", recipe.file.string()},
              {"extends", Json::array()},
              {"variant", recipe.variant},
              {"seed", recipe.seed},
              {"input", {{"taken", plan.input}, {"not_found", plan.not_found}}},
              {"mesh_files", Json::array()},
              {"stages", Json::array()},
              {"budget", json_of_budget(recipe)},
              {"guarantee", to_string(recipe.guarantee)},
              {"links", Json::array()},
              {"outputs", Json::array()}};
    json["input"].update(json_of_planned(plan.input_file));
    for (const RecipeFile& base : recipe.extended) {
        json["extends"].push_back(base.file.string());
    }
    for (const PlannedFile& mesh : plan.meshes) {
        json["mesh_files"].push_back(json_of_planned(mesh));
        json["mesh_files"].back()["loader"] = mesh.loader;
    }
    for (const PlannedStage& stage : plan.stages) {
        json["stages"].push_back(json_of_planned(stage, false));
    }
    if (recipe.self_collision) {
        json["self_collision"] = {{"reference_pose", recipe.self_collision_pose}};
    }
    for (const PlannedLink& link : plan.links) {
        json["links"].push_back(json_of_planned(link));
    }
    for (const PlannedOutput& output : plan.outputs) {
        Json entry = json_of_planned(output.writer, false);
        entry["file"] = output.file;
        json["outputs"].push_back(std::move(entry));
    }
    if (plan.renderer) {
        json["renderer"] = json_of_planned(*plan.renderer, false);
    }
    return json;
}

int plan_recipe(Program& program, const PlanArguments& arguments) {
    Registry& registry = program.registry();
    const RecipeResult read =
        read_recipe_argument(arguments.recipe, registry, settings_of(arguments.settings), arguments.variants);
    require_ok(read, named(arguments.recipe));
    Json runs = Json::array();
    std::string text;
    bool unreadable = false;
    for (const Recipe& recipe : read.recipes) {
        const Plan planned = plan(recipe, registry);
        tell_findings(planned.warnings);
        if (arguments.json) {
            runs.push_back(json_of_planned(planned, recipe));
        } else {
            text += text_of(planned, recipe);
        }
        unreadable = unreadable || std::any_of(planned.links.begin(), planned.links.end(),
                                               [](const PlannedLink& link) { return !link.error.empty(); });
    }
    if (arguments.json) {
        print_json({{"runs", runs}, {"variants", read.variants}});
    } else {
        print(text);
    }
    if (!read.variants.empty() && arguments.variants.empty()) {
        tell(fmt::format("without its variants: {}; --variant selects them", fmt::join(read.variants, ", ")));
    }
    return unreadable ? exit_code(ErrorCode::input) : 0;
}

} // namespace

void add_plan(Program& program) {
    CLI::App* command = add_command(program, "plan", "Show what a recipe would run and what is cached",
                                    "  foam plan configs/panda_22.yaml\n"
                                    "  foam plan my_robot.yaml --variant fine --json");
    auto arguments = std::make_shared<PlanArguments>();
    command->add_option("recipe", arguments->recipe, recipe_help)->type_name("RECIPE")->required();
    add_variants(*command, arguments->variants);
    add_settings(*command, arguments->settings);
    add_strict(*command, arguments->settings);
    command->add_flag("--json", arguments->json, "Print the plan as JSON");
    command->callback(
        [&program, arguments] { program.action = [&program, arguments] { return plan_recipe(program, *arguments); }; });
}

} // namespace foam::cli
