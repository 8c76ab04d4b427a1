#include "cli/files.hpp"
#include "cli/program.hpp"
#include "commands.hpp"

#include <foam/base/error.hpp>
#include <foam/recipe/json.hpp>
#include <foam/runtime/plan.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace foam::cli {
namespace {

struct CheckArguments {
    std::string recipe;
    std::vector<std::string> settings, variants;
    bool json = false;
};

int check_recipe(Program& program, const CheckArguments& arguments) {
    RecipeResult read =
        read_recipe_argument(arguments.recipe, program.registry(), settings_of(arguments.settings), arguments.variants);
    add_unknown_names(read, program.registry());
    if (arguments.json) {
        print_json(json_of_findings<nlohmann::ordered_json>(read));
    } else {
        std::string text;
        for (const Diagnostic& finding : read.diagnostics) {
            text += finding.text() + "\n";
        }
        print(text);
    }
    if (!read.ok()) {
        return exit_code(ErrorCode::recipe);
    }
    tell(fmt::format("{}: valid, {} run{}{}", named(arguments.recipe), read.recipes.size(),
                     read.recipes.size() == 1 ? "" : "s",
                     read.variants.empty() ? "" : fmt::format("; variants: {}", fmt::join(read.variants, ", "))));
    return 0;
}

} // namespace

void add_check(Program& program) {
    CLI::App* command = add_command(program, "check", "List all errors of a recipe without running it",
                                    "  foam check my_robot.yaml\n"
                                    "  foam check my_robot.yaml --set budget.spheres=60 --json");
    auto arguments = std::make_shared<CheckArguments>();
    command->add_option("recipe", arguments->recipe, recipe_help)->type_name("RECIPE")->required();
    add_variants(*command, arguments->variants);
    add_settings(*command, arguments->settings);
    add_strict(*command, arguments->settings);
    command->add_flag("--json", arguments->json, "Print the findings as JSON");
    command->callback([&program, arguments] {
        program.action = [&program, arguments] { return check_recipe(program, *arguments); };
    });
}

} // namespace foam::cli
