#include "program.hpp"

#include "messages.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/runtime/process.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <filesystem>

namespace foam::cli {
namespace {

/// The subcommand that was named; the program itself before one is.
const CLI::App& current(const CLI::App& app) {
    const auto chosen = app.get_subcommands();
    return chosen.empty() ? app : *chosen.front();
}

bool shown_in_help(const CLI::Option* option) {
    return !option->get_group().empty();
}

std::vector<std::string> option_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* level : {&current(app), &app}) {
        for (const CLI::Option* option : level->get_options(shown_in_help)) {
            for (const std::string& name : option->get_lnames()) {
                names.push_back("--" + name);
            }
        }
    }
    return names;
}

/// Returns the commands that have the option, for a message: "; foam spherize and foam convert have it"; empty if none.
std::string others_with(const std::string& name, const CLI::App& app) {
    std::vector<std::string> others;
    for (const CLI::App* command : app.get_subcommands(nullptr)) {
        const CLI::Option* option = command->get_option_no_throw(name);
        if (option && shown_in_help(option)) {
            others.push_back("foam " + command->get_name());
        }
    }
    if (others.empty()) {
        return "";
    }
    const std::string last = others.back();
    others.pop_back();
    return others.empty() ? fmt::format("; {} has it", last)
                          : fmt::format("; {} and {} have it", fmt::join(others, ", "), last);
}

/// Returns whether the word names a file: one that exists, or a name with an ending.
bool looks_like_a_file(const std::string& word) {
    std::error_code error;
    const std::filesystem::path path(word);
    return path.has_extension() || path.has_parent_path() || std::filesystem::is_regular_file(path, error);
}

/// Returns what one usually does with such a file.
std::string commands_for(const std::string& file) {
    const std::string ending = std::filesystem::path(file).extension().string();
    if (ending == ".yaml" || ending == ".yml") {
        return fmt::format("foam run {}", file);
    }
    return fmt::format("foam spherize {0} -n 20, or foam info {0}", file);
}

/// CLI11's own message, or a better one for a word that is not known.
std::string explain(const CLI::App& app, const CLI::ParseError& error) {
    const std::vector<std::string> rest = app.remaining(true);
    const bool no_command = app.get_subcommands().empty();
    for (const std::string& word : rest) {
        if (word.starts_with("-")) {
            const std::string name = word.substr(0, word.find('='));
            const std::string others = no_command ? "" : others_with(name, app);
            return others.empty() ? fmt::format("unknown option '{}'{}", name, did_you_mean(name, option_names(app)))
                                  : fmt::format("foam {} has no option '{}'{}", current(app).get_name(), name, others);
        }
        if (no_command && looks_like_a_file(word)) {
            return fmt::format("'{}' is a file, not a command; remedy: {}", word, commands_for(word));
        }
        if (no_command) {
            std::vector<std::string> commands;
            for (const CLI::App* command : app.get_subcommands(nullptr)) {
                commands.push_back(command->get_name());
            }
            return unknown_command(word, commands);
        }
        return fmt::format("'{}' is one argument too many", word);
    }
    return error.what();
}

int usage_error(const CLI::App& app, const CLI::ParseError& error) {
    const CLI::App& command = current(app);
    tell(explain(app, error));
    tell(fmt::format("`foam {}--help` explains its use", &command == &app ? "" : command.get_name() + " "));
    return exit_code(ErrorCode::usage);
}

/// Makes every option of a command take one value a time, so that none takes the file after it: --with box part.stl.
void take_one_value_each(CLI::App& app) {
    for (CLI::App* command : app.get_subcommands(nullptr)) {
        take_one_value_each(*command);
    }
    for (CLI::Option* option : app.get_options()) {
        if (!option->get_positional()) {
            option->allow_extra_args(false);
        }
    }
}

int run_program(int count, char** arguments, const std::function<void(Program&)>& add_commands) {
    Program program;
    program.arguments = arguments;
    add_commands(program);
    take_one_value_each(program.app);
    if (count <= 1) {
        tell_text(program.app.help());
        return exit_code(ErrorCode::usage);
    }
    try {
        program.app.parse(count, arguments);
        const InterruptRequest request;
        const StopScope scope(&request);
        program.standard_input.take();
        return program.action();
    } catch (const CLI::CallForHelp&) {
        const CLI::App& command = current(program.app);
        print(&command == &program.app ? command.help() : command.help(program.app.get_name()));
        return 0;
    } catch (const CLI::CallForVersion& call) {
        print(fmt::format("{}\n", call.what()));
        return 0;
    } catch (const CLI::ParseError& error) {
        return usage_error(program.app, error);
    }
}

/// Whatever is thrown is reported.
int guarded(int count, char** arguments, const std::function<void(Program&)>& add_commands) {
    try {
        return run_program(count, arguments, add_commands);
    } catch (const Error& error) {
        tell(fmt::format("{}: {}", error.code() == ErrorCode::cancelled ? "stopped" : "error", error.what()));
        return exit_code(error.code());
    } catch (const std::bad_alloc&) {
        tell("error: there is not enough memory; remedy: fewer links or meshes at once, fewer threads (-j), or more "
             "memory");
        return exit_code(ErrorCode::geometry);
    } catch (const std::exception& error) {
        tell(fmt::format("error: {} (a bug in foam; please report it)", error.what()));
        return exit_code(ErrorCode::internal);
    }
}

} // namespace

int run_main(int count, char** arguments, const std::function<void(Program&)>& add_commands) {
    open_closed_streams();
    serve_isolated_call(count, arguments);
    report_ends_by_stages();
    report_crashes();
    stop_on_interrupt();
    choose_colours(Colour::automatic);
    const int code = guarded(count, arguments, add_commands);
    expect_end();
    std::fflush(nullptr); // a signal would leave what is buffered
    return exit_code_after(code);
}

} // namespace foam::cli
