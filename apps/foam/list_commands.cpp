// What can stand in a recipe, and where it comes from: stages, describe, plugins.
#include "cli/program.hpp"
#include "commands.hpp"

#include <foam/base/error.hpp>
#include <foam/recipe/json.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace foam::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string limits(const Parameter& p) {
    if (p.type == Parameter::Type::choice) {
        return fmt::format("{}", fmt::join(p.choices, " | "));
    }
    std::string text = to_string(p.type);
    if (p.low && p.high) {
        text += fmt::format(" {} … {}", to_text(*p.low), to_text(*p.high));
    } else if (p.low) {
        text += fmt::format(" ≥ {}", to_text(*p.low));
    } else if (p.high) {
        text += fmt::format(" ≤ {}", to_text(*p.high));
    }
    return p.unit_text.empty() || p.unit_text == "1" ? text : text + " " + p.unit_text;
}

/// By the keys of recipes.
std::string isolation_text(const Isolation& isolation) {
    std::vector<std::string> parts;
    if (isolation.process) {
        parts.push_back(fmt::format("isolate: {}", *isolation.process ? "process" : "none"));
    }
    if (isolation.time_limit) {
        parts.push_back(fmt::format("time_limit: {}", *isolation.time_limit));
    }
    if (isolation.memory_limit) {
        parts.push_back(fmt::format("memory_limit: {}", *isolation.memory_limit));
    }
    return fmt::format("{}", fmt::join(parts, ", "));
}

std::string description(const RegisteredStage& stage) {
    std::string text = fmt::format("{} ({}, plugin {} {}, {})\n{}\n", stage.info.name, to_string(stage.kind),
                                   stage.plugin, stage.plugin_version, stage.license, stage.info.summary);
    if (!stage.info.reference.empty()) {
        text += fmt::format("After: {}\n", stage.info.reference);
    }
    if (!stage.info.extensions.empty()) {
        text += fmt::format("Files: .{}", fmt::join(stage.info.extensions, " ."));
        text += stage.info.companions.empty()
                    ? "\n"
                    : fmt::format(", and under the same name .{}\n", fmt::join(stage.info.companions, " ."));
    }
    if (stage.info.last_resort) {
        text +=
            "Reads the files that no other loader reads, or all of these formats if 'loaders: {prefer: …}' names it.\n";
    }
    if (const std::string isolation = isolation_text(stage.info.isolation); !isolation.empty()) {
        text += fmt::format("Default isolation: {}\n", isolation);
    }
    if (stage.info.original_only) {
        text += "Uses only the original geometry: mesh filters before it have no effect.\n";
    }
    if (!stage.info.objective_parameter.empty()) {
        text += fmt::format("Objective: parameter {}.\n", stage.info.objective_parameter);
    }
    text += stage.info.parameters.empty() ? "No parameters.\n" : "\nParameters:\n";
    for (const Parameter& p : stage.info.parameters) {
        const std::string value = to_text(p.default_value);
        text +=
            fmt::format("  {}: {}    # {}\n      {}\n", p.name, value.empty() ? "\"\"" : value, limits(p), p.doc_text);
        if (!p.source_text.empty()) {
            text += fmt::format("      Default from: {}\n", p.source_text);
        }
    }
    return text;
}

int list_stages(Program& program, bool as_json) {
    const Registry& registry = program.registry();
    Json json = Json::array();
    std::string text;
    for (const auto& [name, stage] : registry.stages()) {
        json.push_back(json_of_stage<Json>(stage));
        text += fmt::format("{:<22} {:<13} {}\n", name, to_string(stage.kind), stage.info.summary);
    }
    if (as_json) {
        print_json(json);
    } else {
        print(text);
    }
    return 0;
}

int describe_stage(Program& program, const std::string& name, bool as_json) {
    const Registry& registry = program.registry();
    const RegisteredStage* stage = registry.find(name);
    if (!stage) {
        const std::string near = registry.nearest(name);
        throw Error(ErrorCode::usage, fmt::format("unknown stage '{}'{}", name,
                                                  near.empty() ? "; `foam stages` lists them"
                                                               : fmt::format("; did you mean '{}'?", near)));
    }
    if (as_json) {
        print_json(json_of_stage<Json>(*stage));
    } else {
        print(description(*stage));
    }
    return 0;
}

int list_plugins(Program& program, bool why, bool as_json) {
    const Registry& registry = program.probed_registry();
    Json json = Json::array();
    std::string text;
    std::size_t refused = 0;
    for (const PluginRecord& record : registry.plugins()) {
        refused += record.loaded() ? 0 : 1;
        json.push_back(json_of_plugin<Json>(record));
        if (record.loaded()) {
            text += fmt::format("{:<20} {:<8} {:<18} {}\n", record.name, record.version, record.license,
                                fmt::join(record.stages, ", "));
        }
        if (why) {
            text += record.loaded() ? fmt::format("  loaded from {}\n", record.file.string())
                                    : fmt::format("{}\n  refused: {}\n", record.file.string(), record.rejection);
        }
    }
    if (why) {
        for (const auto& folder : program.plugin_folders()) {
            text += fmt::format("looked in {}\n", folder.string());
        }
    }
    if (as_json) {
        print_json(json);
    } else {
        print(text);
    }
    if (refused > 0 && !why && !as_json) {
        tell(fmt::format("{} more refused; `foam plugins --why` shows why", refused));
    }
    return 0;
}

} // namespace

void add_stages(Program& program) {
    CLI::App* command =
        add_command(program, "stages", "List the stages that recipes can use", "  foam stages\n  foam stages --json");
    auto json = std::make_shared<bool>(false);
    command->add_flag("--json", *json, "Print the stages as JSON, with all parameters");
    command->callback([&program, json] { program.action = [&program, json] { return list_stages(program, *json); }; });
}

void add_describe(Program& program) {
    CLI::App* command = add_command(program, "describe", "Explain a stage and its parameters",
                                    "  foam describe spherize.medial\n  foam describe write.json --json");
    auto name = std::make_shared<std::string>();
    auto json = std::make_shared<bool>(false);
    command->add_option("stage", *name, "Name of the stage, kind.method")->type_name("STAGE")->required();
    command->add_flag("--json", *json, "Print the stage as JSON");
    command->callback([&program, name, json] {
        program.action = [&program, name, json] { return describe_stage(program, *name, *json); };
    });
}

void add_plugins(Program& program) {
    CLI::App* command = add_command(program, "plugins", "List the plugins",
                                    "  foam plugins --why\n  foam plugins --plugin ./mine.so --why");
    auto why = std::make_shared<bool>(false), json = std::make_shared<bool>(false);
    command->add_flag("--why", *why, "Show the file of each plugin, and why plugins were refused");
    command->add_flag("--json", *json, "Print the plugins as JSON");
    command->callback([&program, why, json] {
        program.action = [&program, why, json] { return list_plugins(program, *why, *json); };
    });
}

} // namespace foam::cli
