// foam version: what foam is made of.
#include "cli/program.hpp"
#include "commands.hpp"

#include <foam/runtime/version.hpp>
#include <foam/sdk/abi.hpp>
#include <foam/sdk/registry.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace foam::cli {
namespace {

nlohmann::ordered_json about() {
    auto libraries = library_versions();
    libraries["cli11"] = CLI11_VERSION;
    return {{"foam_version", version()},  {"foam_build", build_of_libraries()},
            {"built_from", build_text()}, {"abi", FOAM_ABI_FINGERPRINT},
            {"compiler", __VERSION__},    {"libraries", libraries}};
}

std::string text_of(const nlohmann::ordered_json& about) {
    std::string text;
    const auto add = [&text](const std::string& name, const nlohmann::ordered_json& value) {
        text += fmt::format("{:<14} {}\n", name, value.get<std::string>());
    };
    add("foam", about["foam_version"]);
    add("build", about["built_from"]);
    add("abi", about["abi"]);
    add("compiler", about["compiler"]);
    for (const auto& [name, value] : about["libraries"].items()) {
        add(name, value);
    }
    return text;
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
            } else {
                print(text_of(all));
            }
            return 0;
        };
    });
}

} // namespace foam::cli
