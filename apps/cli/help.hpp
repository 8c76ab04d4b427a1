// Help: what a program says of its commands, in text, manual pages and completions.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace foam::cli {

// The help texts: a column of names, and descriptions that are wrapped so that no line exceeds a terminal of 80
// columns.

/// Returns the words that the option's value can be, of its type "mm|cm|m"; empty for another type.
std::vector<std::string> words_of(const CLI::Option& option);

/// Formats the help of the program and of its commands. CLI11's own formatter never breaks a line.
class HelpFormatter final : public CLI::Formatter {
public:
    /// Returns the help without the empty line that CLI11 leaves for options that are not shown.
    std::string make_help(const CLI::App* command, std::string name, CLI::AppFormatMode mode) const override;
    std::string make_subcommand(const CLI::App* command) const override;
    std::string make_option(const CLI::Option* option, bool is_positional) const override;
    /// Returns the type of the option's value. The default is part of the description.
    std::string make_option_opts(const CLI::Option* option) const override;
    std::string make_option_desc(const CLI::Option* option) const override;
};

struct DescribedOption {
    std::vector<std::string> names; ///< "-n", "--spheres"; of a positional its name in the help
    bool positional = false;
    std::string value;                ///< what its value is called, e.g. "N"; empty: it has none
    std::vector<std::string> choices; ///< the words that its value can be; empty: any
    std::string text;                 ///< with its default
};

struct DescribedCommand {
    std::string name, summary, footer;
    std::vector<DescribedOption> options; ///< as declared, without `--help`
};

struct DescribedProgram {
    DescribedCommand program; ///< options that every command takes
    std::vector<DescribedCommand> commands;
};

/// Returns what the program's help shows, in its order.
DescribedProgram described(const CLI::App& app);

/// Returns the shells that completion_script() knows: bash, zsh, fish.
const std::vector<std::string>& completion_shells();

/// Returns the script that completes commands, options, words of options and arguments, and file names. Throws
/// Error(usage) for another shell.
std::string completion_script(const DescribedProgram& program, const std::string& shell);

/// Returns the page of the program (`command` empty: foam.1), or that of a command (foam-run.1), in the man macros of
/// roff. Throws Error(usage) for a command that the program does not have.
std::string manual_page(const DescribedProgram& program, const std::string& command, const std::string& version);

} // namespace foam::cli
