#include "program.hpp"

#include "help.hpp"
#include "messages.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/length.hpp>
#include <foam/runtime/process.hpp>
#include <foam/runtime/version.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>

namespace foam::cli {

Program::Program() : app("foam approximates robots and objects by spheres that are proved to enclose them.", "foam") {
    app.set_version_flag("--version", fmt::format("foam {} ({})", version(), build_text()), "Print the version");
    app.set_help_flag("-h,--help", "Print this help");
    app.fallthrough();
    app.require_subcommand(1);
    app.formatter(std::make_shared<HelpFormatter>());
    app.add_option("--plugin", plugin_files_, "Also load this plugin; repeatable")
        ->type_name("FILE")
        ->expected(1)
        ->take_all();
    app.add_option("--plugin-dir", plugin_folders_, "Also load the plugins of this folder; repeatable")
        ->type_name("DIR")
        ->expected(1)
        ->take_all()
        ->check(CLI::Validator(CLI::ExistingDirectory).description("")); // the help would say DIR:DIR
    app.add_option_function<std::string>(
           "--color",
           [](const std::string& word) {
               choose_colours(word == "always" ? Colour::always : word == "never" ? Colour::never : Colour::automatic);
           },
           "Colours in messages; auto: on a terminal, unless NO_COLOR is set or TERM is dumb; default: auto")
        ->type_name("auto|always|never")
        ->check(CLI::IsMember({"auto", "always", "never"}).description(""));
    app.footer("Examples:\n"
               "  foam run configs/panda_22.yaml              run a recipe\n"
               "  foam spherize robot.urdf -n 60              a robot, without a recipe\n"
               "  foam spherize part.stl -n 16 -o part.json   a mesh, without a recipe\n"
               "  foam stages                                 the stages that recipes can use\n"
               "\n"
               "Exit codes: 0 done, 1 a stage failed, 2 invalid recipe or command line,\n"
               "            3 plugin refused, 4 done except for some links, 130 cancelled.\n"
               "`foam COMMAND --help` explains a command.");
}

std::vector<std::filesystem::path> Program::plugin_folders() const {
    return plugin_directories({plugin_folders_.begin(), plugin_folders_.end()});
}

Registry& Program::registry(bool warn) {
    if (!registry_) {
        registry_.emplace();
        fill(warn);
    }
    return *registry_;
}

Registry& Program::probed_registry() {
    registry_.emplace().set_guard([own = plugin_folders().back()](const std::filesystem::path& file) {
        return file.parent_path() == own ? "" : why_loading_ends_badly(own_program, file);
    });
    return fill(false);
}

Registry& Program::fill(bool warn) {
    Registry& registry = *registry_;
    for (const std::string& file : plugin_files_) {
        const PluginRecord& record = registry.load(file);
        if (!record.loaded()) {
            throw Error(ErrorCode::plugin,
                        fmt::format("plugin {} is refused: {}", record.file.string(), record.rejection));
        }
    }
    for (const auto& folder : plugin_folders()) {
        registry.load_directory(folder);
    }
    for (const PluginRecord& record : registry.plugins()) {
        if (warn && !record.loaded()) {
            tell(fmt::format("warning: plugin {} is refused: {}", record.file.string(), record.rejection));
        }
    }
    return registry;
}

CLI::App* add_command(Program& program, const std::string& name, const std::string& summary,
                      const std::string& examples) {
    CLI::App* command = program.app.add_subcommand(name, summary);
    command->footer("Examples:\n" + examples);
    return command;
}

void add_settings(CLI::App& command, std::vector<std::string>& texts) {
    command
        .add_option("--set", texts,
                    "Change a value of the recipe, e.g. budget.spheres=60 or stages.simplify.quadric.ratio=0.1; "
                    "repeatable")
        ->type_name("KEY=VALUE")
        ->expected(1)
        ->take_all();
}

void add_strict(CLI::App& command, std::vector<std::string>& texts) {
    command.add_flag_callback(
        "--strict", [&texts] { texts.emplace_back("strict=true"); },
        "Treat a glob that matches no link as an error, like strict: true in the recipe");
}

void add_variants(CLI::App& command, std::vector<std::string>& names) {
    command
        .add_option("--variant", names,
                    "Run this variant instead of the recipe itself; '*' runs all variants; repeatable")
        ->type_name("NAME")
        ->expected(1)
        ->take_all();
}

void add_threads(CLI::App& command, std::size_t& threads) {
    command.add_option("-j,--threads", threads, "Threads, at most 1024; default: one per core")
        ->type_name("N")
        ->check(whole_number(1, 1024));
}

void add_packages(CLI::App& command, std::vector<std::string>& texts) {
    command.add_option("--package", texts, "The folder of a package that the robot's meshes are in; repeatable")
        ->type_name("NAME=FOLDER")
        ->expected(1)
        ->take_all();
}

std::vector<std::filesystem::path> package_path_of(const std::vector<std::string>& texts) {
    std::vector<std::filesystem::path> path;
    for (const std::string& text : texts) {
        const std::size_t equals = text.find('=');
        if (equals == text.npos || equals == 0 || equals + 1 == text.size() || text.find('/') < equals) {
            throw Error(ErrorCode::usage, fmt::format("--package expects NAME=FOLDER, got '{}'", text));
        }
        path.push_back(package_entry(text, std::filesystem::current_path()));
    }
    return path;
}

void add_mesh_unit(CLI::App& command, MeshUnit& unit) {
    command.add_option("--unit", unit.unit, "Unit of the mesh, for formats without a unit; default: m")
        ->type_name(fmt::format("{}", fmt::join(length_units(), "|")))
        ->check(CLI::IsMember(length_units()).description(""));
    command.add_option("--scale", unit.scale, "Scale factor of the mesh, in addition to its unit; default: 1")
        ->type_name("F")
        ->check(number_above(0));
}

double length_of(const std::string& text, const std::string& option) {
    const std::optional<double> metres = parse_length(text);
    if (!metres) {
        throw Error(ErrorCode::usage, fmt::format("{} expects {}; got '{}'", option, length_forms(), text));
    }
    return *metres;
}

std::vector<Setting> settings_of(const std::vector<std::string>& texts) {
    std::vector<Setting> settings;
    for (const std::string& text : texts) {
        const std::size_t equals = text.find('=');
        if (equals == text.npos || equals == 0) {
            throw Error(ErrorCode::usage, fmt::format("--set expects key.path=value, got '{}'", text));
        }
        settings.emplace_back(text.substr(0, equals), text.substr(equals + 1));
    }
    return settings;
}

void print(std::string_view text) {
    print_data(coloured(shown_lines(with_names(std::string(text))), Stream::out));
}

void print_data(std::string_view bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() || std::fflush(stdout) != 0) {
        throw Error(ErrorCode::output, "cannot write to the standard output");
    }
}

void print_json(const nlohmann::ordered_json& json) {
    const auto dumped = [&json](bool ascii) {
        return with_names(json.dump(2, ' ', ascii, nlohmann::ordered_json::error_handler_t::replace)) + "\n";
    };
    const std::string text = dumped(false);
    print_data(shown_lines(text) == text ? text : dumped(true));
}

void tell(std::string_view line) {
    tell_text(fmt::format("foam: {}\n", line));
}

void tell_text(std::string_view text) {
    const std::string shown = coloured(shown_lines(with_names(std::string(text))), Stream::err);
    std::fwrite(shown.data(), 1, shown.size(), stderr); // nobody is left to be told that it failed
}

void tell_findings(const std::vector<Diagnostic>& findings) {
    for (const Diagnostic& finding : findings) {
        tell_text(finding.text() + "\n");
    }
}

} // namespace foam::cli
