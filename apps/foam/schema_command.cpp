// foam schema: what recipes may hold, and what foam writes and prints.
#include "cli/messages.hpp"
#include "commands.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/recipe/recipe.hpp>
#include <foam/runtime/version.hpp>

#include <fmt/format.h>

namespace foam::cli {
namespace {

constexpr const char* of_recipes = "recipe";

std::vector<std::string> all_names() {
    std::vector<std::string> names = schema_names();
    names.insert(names.begin(), of_recipes);
    return names;
}

int print_schema(Program& program, const std::string& name) {
    const std::string text = name == of_recipes ? recipe_schema(program.registry()) : schema_named(name);
    if (text.empty()) {
        throw Error(ErrorCode::usage, fmt::format("there is no schema '{}'; there are: {}{}", shown(name),
                                                  fmt::join(all_names(), ", "), did_you_mean(name, all_names())));
    }
    print_data(text);
    return 0;
}

} // namespace

void add_schema(Program& program) {
    CLI::App* command =
        add_command(program, "schema", "Print the JSON Schema of recipes, result files or a command's JSON",
                    "  foam schema > recipe.schema.json\n"
                    "  foam schema manifest > manifest.schema.json\n"
                    "  foam schema evaluate                     of what foam evaluate --json prints\n"
                    "\n"
                    "For completion in an editor, begin the recipe with this line:\n"
                    "  # yaml-language-server: $schema=recipe.schema.json");
    auto name = std::make_shared<std::string>(of_recipes);
    command->add_option("what", *name, "The schema")
        ->default_str(of_recipes)
        ->type_name(fmt::format("{}", fmt::join(all_names(), "|")));
    command->add_flag("--json")->description("Accepted for uniformity: the schema is always JSON");
    command->callback([&program, name] { program.action = [&program, name] { return print_schema(program, *name); }; });
}

} // namespace foam::cli
