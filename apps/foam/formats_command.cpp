// foam formats: what is read and written.
#include "commands.hpp"
#include "engine_option.hpp"

#include <foam/sdk/kinds.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace foam::cli {
namespace {

struct Format {
    const StageInfo* writes = nullptr;
    const StageInfo* reads = nullptr;
};

/// Returns the formats by name: "curobo" of write.curobo and read.curobo.
std::map<std::string, Format> formats_of(const Registry& registry) {
    std::map<std::string, Format> formats;
    for (const auto& [name, stage] : registry.stages()) {
        Format& format = formats[name.substr(name.find('.') + 1)];
        if (stage.kind == StageKind::writer) {
            format.writes = &stage.info;
        } else if (stage.kind == StageKind::model_reader) {
            format.reads = &stage.info;
        }
    }
    std::erase_if(formats, [](const auto& entry) { return !entry.second.writes && !entry.second.reads; });
    return formats;
}

bool reads(const Engine& engine, const std::string& writer) {
    return std::find(engine.writers.begin(), engine.writers.end(), writer) != engine.writers.end();
}

nlohmann::ordered_json json_of_formats(const std::map<std::string, Format>& formats) {
    auto json = nlohmann::ordered_json::array();
    for (const auto& [name, format] : formats) {
        nlohmann::ordered_json entry{
            {"format", name}, {"reads", format.reads != nullptr}, {"writes", format.writes != nullptr}};
        if (format.writes) {
            const Consumer& consumer = format.writes->consumer;
            entry["extensions"] = format.writes->extensions;
            entry["consumer"] = consumer.name;
            entry["into"] = consumer.edits;
            entry["lists_pairs"] = consumer.pairs;
            entry["lists_pairs_if"] = consumer.pairs_if;
            entry["companions"] = format.writes->companions;
            entry["float32"] = consumer.float32;
            entry["engines"] = nlohmann::ordered_json::array();
            for (const Engine& engine : engines()) {
                if (reads(engine, format.writes->name)) {
                    entry["engines"].push_back(engine.name);
                }
            }
        }
        json.push_back(std::move(entry));
    }
    return json;
}

std::string table_of_formats(const std::map<std::string, Format>& formats) {
    std::string table =
        fmt::format("{:<18} {:<5} {:<6} {:<5} {:<6} {}\n", "format", "read", "write", "into", "pairs", "read by");
    for (const auto& [name, format] : formats) {
        const Consumer consumer = format.writes ? format.writes->consumer : Consumer{};
        table += fmt::format("{:<18} {:<5} {:<6} {:<5} {:<6} {}", name, format.reads ? "yes" : "-",
                             format.writes ? "yes" : "-", consumer.edits ? "yes" : "-",
                             !consumer.pairs             ? "-"
                             : consumer.pairs_if.empty() ? "yes"
                                                         : consumer.pairs_if,
                             consumer.name);
        table.erase(table.find_last_not_of(' ') + 1);
        table += '\n';
    }
    return table;
}

std::string table_of_engines() {
    std::string table = fmt::format("{:<10} {:<32} {:<15} {}\n", "--for", "program", "format", "kinds");
    for (const Engine& engine : engines()) {
        std::vector<std::string_view> formats;
        for (const std::string_view writer : engine.writers) {
            formats.push_back(writer.substr(writer.find('.') + 1));
        }
        table += fmt::format("{:<10} {:<32} {:<15} {}\n", engine.name, engine.title,
                             fmt::format("{}", fmt::join(formats, ", ")),
                             engine.kinds == every_kind() ? "all" : words_of(engine.kinds));
    }
    return table;
}

} // namespace

void add_formats(Program& program) {
    CLI::App* command = add_command(program, "formats", "List the formats of sphere models that are read and written",
                                    "  foam formats\n"
                                    "  foam formats --for pybullet\n"
                                    "  foam formats --json\n"
                                    "\n"
                                    "into: spheres are replaced in a file of the user, the rest keeps its bytes.\n"
                                    "pairs: the format lists the pairs of links that need no check; a word is the\n"
                                    "parameter of the writer that switches them on.\n"
                                    "--for: programs that `foam spherize`, `approximate` and `convert` write for.");
    struct Arguments {
        bool json = false;
        std::string engine;
    };
    auto arguments = std::make_shared<Arguments>();
    CLI::Option* json = command->add_flag("--json", arguments->json, "Print the formats as JSON");
    command->add_option("--for", arguments->engine, "Say what this program takes away, and what foam does about it")
        ->type_name("ENGINE")
        ->excludes(json);
    command->callback([&program, arguments] {
        program.action = [&program, arguments] {
            const std::map<std::string, Format> formats = formats_of(program.registry());
            if (!arguments->engine.empty()) {
                print(text_about(engine_named(arguments->engine)));
            } else if (arguments->json) {
                print_json(json_of_formats(formats));
            } else {
                print(table_of_formats(formats) + "\n" + table_of_engines());
            }
            return 0;
        };
    });
}

} // namespace foam::cli
