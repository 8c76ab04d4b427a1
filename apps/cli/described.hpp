// The commands and options of a program as data, for completions and manual pages.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace foam::cli {

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

} // namespace foam::cli
