// foam version: what foam is made of.
#include "cli/build_text.hpp"
#include "cli/program.hpp"
#include "commands.hpp"

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

} // namespace foam::cli
