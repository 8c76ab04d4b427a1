// foam help, foam completion and foam manual: the declared commands and options as texts.
#include "cli/help.hpp"
#include "cli/messages.hpp"
#include "commands.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/runtime/version.hpp>

#include <fmt/format.h>

namespace foam::cli {
namespace {

int help(Program& program, const std::string& name) {
    if (name.empty()) {
        // App::help() shows the command that was named, which is this one.
        print(program.app.get_formatter()->make_help(&program.app, program.app.get_name(), CLI::AppFormatMode::Normal));
        return 0;
    }
    std::vector<std::string> names;
    for (const CLI::App* command : program.app.get_subcommands(nullptr)) {
        if (command->get_name() == name) {
            print(command->help(program.app.get_name()));
            return 0;
        }
        names.push_back(command->get_name());
    }
    throw Error(ErrorCode::usage, unknown_command(shown(name), names));
}

} // namespace

void add_help(Program& program) {
    CLI::App* command = add_command(program, "help", "Explain a command",
                                    "  foam help\n"
                                    "  foam help spherize                       the same as foam spherize --help");
    auto name = std::make_shared<std::string>();
    command->add_option("command", *name, "The command; without it: the list of commands")->type_name("COMMAND");
    command->callback([&program, name] { program.action = [&program, name] { return help(program, *name); }; });
}

void add_completion(Program& program) {
    CLI::App* command = add_command(program, "completion", "Print a script that completes commands in a shell",
                                    "  source <(foam completion bash)           in ~/.bashrc\n"
                                    "  foam completion zsh > ~/.zfunc/_foam     with fpath+=~/.zfunc in ~/.zshrc\n"
                                    "  foam completion fish > ~/.config/fish/completions/foam.fish");
    auto shell = std::make_shared<std::string>();
    command->add_option("shell", *shell, "The shell")
        ->type_name(fmt::format("{}", fmt::join(completion_shells(), "|")))
        ->required();
    command->callback([&program, shell] {
        program.action = [&program, shell] {
            print_data(completion_script(described(program.app), *shell));
            return 0;
        };
    });
}

void add_manual(Program& program) {
    CLI::App* command = add_command(program, "manual", "Print a manual page for man",
                                    "  foam manual > foam.1\n"
                                    "  foam manual spherize | man -l -");
    auto name = std::make_shared<std::string>();
    command->add_option("command", *name, "The command; without it: the page of foam itself")->type_name("COMMAND");
    command->callback([&program, name] {
        program.action = [&program, name] {
            print_data(manual_page(described(program.app), *name, version()));
            return 0;
        };
    });
}

} // namespace foam::cli
