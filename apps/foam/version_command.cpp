// What foam is and what its recipes may hold: version, schema.
#include "cli/build_text.hpp"
#include "cli/program.hpp"
#include "commands.hpp"

#include <foam/runtime/schemas.hpp>
#include <foam/runtime/version.hpp>
#include <foam/sdk/abi.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace foam::cli {
namespace {

nlohmann::ordered_json about() {
    nlohmann::ordered_json json{
        {"foam", version()}, {"build", build_text()}, {"abi", FOAM_ABI_FINGERPRINT}, {"compiler", __VERSION__}};
    auto libraries = library_versions();
    libraries["cli11"] = CLI11_VERSION;
    json["libraries"] = libraries;
    return json;
}

} // namespace

void add_version(Program& program) {
    CLI::App* command = add_command(program, "version", "Print versions and the plugin ABI", "  foam version --json");
    auto json = std::make_shared<bool>(false);
    command->add_flag("--json", *json, "Print the versions as JSON");
    command->callback([&program, json] {
        program.action = [json] {
            const auto all = about();
            if (*json) {
                print_json(all);
                return 0;
            }
            std::string text;
            for (const auto& [key, value] : all.items()) {
                if (value.is_string()) {
                    text += fmt::format("{:<14} {}\n", key, value.get<std::string>());
                }
            }
            for (const auto& [key, value] : all["libraries"].items()) {
                text += fmt::format("{:<14} {}\n", key, value.get<std::string>());
            }
            print(text);
            return 0;
        };
    });
}

void add_schema(Program& program) {
    CLI::App* command = add_command(program, "schema", "Print the JSON Schema of recipes or result files",
                                    "  foam schema > recipe.schema.json\n"
                                    "  foam schema manifest > manifest.schema.json\n"
                                    "\n"
                                    "For completion in an editor, begin the recipe with this line:\n"
                                    "  # yaml-language-server: $schema=recipe.schema.json");
    auto what = std::make_shared<std::string>("recipe");
    command->add_option("what", *what, "recipe (default), manifest or spheres")
        ->type_name("WHAT")
        ->check(CLI::IsMember({"recipe", "manifest", "spheres"}).description(""));
    command->add_flag("--json")->description("Accepted for uniformity: the schema is always JSON");
    command->callback([&program, what] {
        program.action = [&program, what] {
            print_data(*what == "manifest"  ? manifest_schema()
                       : *what == "spheres" ? spheres_schema()
                                            : recipe_schema(program.registry()));
            return 0;
        };
    });
}

} // namespace foam::cli
