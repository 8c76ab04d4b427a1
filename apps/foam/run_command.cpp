#include "cli/files.hpp"
#include "commands.hpp"
#include "execute.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/runtime/run_json.hpp>
#include <foam/runtime/verify.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <optional>

namespace foam::cli {
namespace {

namespace fs = std::filesystem;

struct RunArguments {
    std::string recipe, run_dir, locked;
    std::vector<std::string> settings, variants;
    ExecuteOptions execute;
    bool json = false;
};

/// A line that says where most of the time went: "Time: 0.62 s (spheres 0.25 s, pictures 0.31 s), CPU 0.93 s".
std::string times_text(const RunResult& result) {
    std::string text;
    for (const RunPhase& phase : result.phases) {
        if (phase.phase == "spheres" || phase.phase == "pictures") {
            text += fmt::format("{}{} {:.2f} s", text.empty() ? "" : ", ", phase.phase, phase.seconds);
        }
    }
    return fmt::format("Time: {:.2f} s ({}), CPU {:.2f} s\n", result.seconds, text, result.cpu_seconds);
}

/// The outputs and the report by name, the rest by number.
std::string files_text(const Recipe& recipe, const RunResult& result, const fs::path& directory) {
    std::string text = fmt::format("Written to {}:", directory.string());
    for (const OutputCall& output : recipe.outputs) {
        text += " " + output.file;
    }
    constexpr const char* report = "report.html"; // missing where a time limit left no time for it
    const bool has_report = std::find(result.files.begin(), result.files.end(), report) != result.files.end();
    const std::size_t named = recipe.outputs.size() + (has_report ? 1 : 0);
    const std::size_t others = result.files.size() - std::min(result.files.size(), named);
    if (others > 0) {
        text += " and " + counted(others, "more file");
    }
    return text + (has_report ? fmt::format("\nReport: {}\n", (directory / report).string()) : "\n") + times_text(result);
}

/// Of a sweep, the one run that the manifest is of.
void keep_locked(std::vector<Recipe>& recipes, const std::string& name, const std::string& manifest) {
    if (recipes.size() > 1) {
        std::erase_if(recipes, [&](const Recipe& recipe) { return recipe.name != name; });
        if (recipes.empty()) {
            throw Error(ErrorCode::usage,
                        fmt::format("{} is of a run '{}', which is not among those of the recipe", manifest, name));
        }
    }
}

int run_recipe(Program& program, RunArguments arguments) {
    Registry& registry = program.registry();
    std::optional<Lock> lock;
    if (!arguments.locked.empty()) {
        lock.emplace(arguments.locked);
        arguments.recipe = arguments.recipe.empty() ? lock->resolved_recipe().string() : arguments.recipe;
        arguments.execute.accept = [&lock](const std::string& manifest) { lock->check_outputs(manifest); };
    } else if (arguments.recipe.empty()) {
        throw Error(ErrorCode::usage, "recipe is required; `foam run --help` explains its use");
    }
    RecipeResult read =
        read_recipe_argument(arguments.recipe, registry, settings_of(arguments.settings), arguments.variants);
    if (lock && !read.ok()) {
        lock->check_plugins(registry);
    }
    require_ok(read, named(arguments.recipe));
    if (lock) {
        keep_locked(read.recipes, lock->name(), arguments.locked);
        lock->check_start(read.recipes.front(), registry);
    }
    int code = 0;
    nlohmann::ordered_json runs = nlohmann::ordered_json::array();
    for (const Recipe& recipe : read.recipes) {
        // A sweep has a folder for each point, and so have several variants.
        fs::path directory = arguments.run_dir.empty() ? fs::path("runs") / recipe.name : fs::path(arguments.run_dir);
        if (!arguments.run_dir.empty() && read.recipes.size() > 1) {
            directory /= recipe.name;
        }
        const RunResult result = execute(recipe, registry, directory, arguments.execute);
        code = std::max(code, exit_code_of(result));
        if (arguments.json) {
            runs.push_back(json_of_run<nlohmann::ordered_json>(result, recipe, directory));
        } else if (!arguments.execute.quiet) {
            print(table_of(result, recipe.guarantee) + files_text(recipe, result, directory));
        }
        if (result.cut == Cut::stop) {
            break; // the other runs of a sweep are not wanted either
        }
    }
    if (arguments.json) {
        print_json({{"runs", runs}});
    }
    return code;
}

} // namespace

void add_run(Program& program) {
    CLI::App* command = add_command(program, "run", "Run a recipe",
                                    "  foam run configs/panda_22.yaml\n"
                                    "  foam run configs/panda_22.yaml --set budget.spheres=60 --run-dir panda_60\n"
                                    "  foam run configs/panda_22.yaml -j 4 --fresh --json\n"
                                    "  foam run my_robot.yaml --variant fine\n"
                                    "  foam run --locked manifest.json panda_22.yaml");
    auto arguments = std::make_shared<RunArguments>();
    command->add_option("recipe", arguments->recipe, recipe_help)->type_name("RECIPE");
    command
        ->add_option(
            "--locked", arguments->locked,
            "Refuse versions, inputs, settings and outputs that differ from this manifest; without RECIPE, run "
            "the recipe.resolved.yaml next to it")
        ->type_name("MANIFEST");
    add_run_directory(*command, arguments->run_dir, "Run directory; default: runs/NAME with the name of the recipe");
    refuse_output_file(*command);
    add_variants(*command, arguments->variants);
    add_settings(*command, arguments->settings);
    add_strict(*command, arguments->settings);
    add_execute_options(*command, arguments->execute);
    command->add_flag("--json", arguments->json, "Print the result as JSON");
    command->callback(
        [&program, arguments] { program.action = [&program, arguments] { return run_recipe(program, *arguments); }; });
}

} // namespace foam::cli
