#include "described.hpp"

#include "help.hpp"

namespace foam::cli {
namespace {

DescribedOption described_option(const CLI::Option& option) {
    DescribedOption result;
    result.positional = !option.nonpositional();
    for (const std::string& name : option.get_snames()) {
        result.names.push_back("-" + name);
    }
    for (const std::string& name : option.get_lnames()) {
        result.names.push_back("--" + name);
    }
    if (result.positional) {
        result.names.assign(1, option.get_name(true));
    }
    if (option.get_type_size() != 0) {
        result.value = option.get_type_name();
        result.choices = words_of(option);
    }
    result.text = HelpFormatter().make_option_desc(&option);
    return result;
}

DescribedCommand described_command(const CLI::App& app) {
    DescribedCommand result{app.get_name(), app.get_description(), app.get_footer(), {}};
    for (const CLI::Option* option : app.get_options()) {
        if (option != app.get_help_ptr() && !option->get_group().empty()) {
            result.options.push_back(described_option(*option));
        }
    }
    return result;
}

} // namespace

DescribedProgram described(const CLI::App& app) {
    DescribedProgram result{described_command(app), {}};
    for (const CLI::App* command : app.get_subcommands(nullptr)) {
        result.commands.push_back(described_command(*command));
    }
    std::vector<std::string> names; // a COMMAND is one of these, all of which are known only here
    for (const DescribedCommand& command : result.commands) {
        names.push_back(command.name);
    }
    for (DescribedCommand& command : result.commands) {
        for (DescribedOption& option : command.options) {
            if (option.value == "COMMAND") {
                option.choices = names;
            }
        }
    }
    return result;
}

} // namespace foam::cli
