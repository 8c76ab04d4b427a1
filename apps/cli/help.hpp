// The help texts: a column of names, and descriptions that are wrapped so that no line exceeds a terminal of 80
// columns.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace foam::cli {

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

} // namespace foam::cli
