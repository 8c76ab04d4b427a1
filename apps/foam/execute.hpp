// From a checked recipe to a finished run, with all that a person is told about it.
#pragma once

#include "cli/program.hpp"

#include <foam/runtime/run.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace foam::cli {

struct ExecuteOptions {
    std::size_t threads = 0; ///< 0: all cores
    bool fresh = false;
    bool verbose = false;
    bool quiet = false;               ///< only warnings and errors: no size of the input, bar, table or names of files
    bool say_which = true;            ///< of the recipe's candidates is the input
    bool force = false;               ///< replace inputs
    bool report = true;               ///< of the run directory
    std::optional<double> time_limit; ///< s; instead of the recipe's
    std::filesystem::path input_name; ///< see RunOptions
    std::vector<std::filesystem::path> targets; ///< where the result goes beside the run directory
    /// Looks at the manifest before anything is put in place; see RunOptions.
    std::function<void(const std::string& manifest)> accept;
};

/// `-j`, `--fresh`, `--time-limit`, `-v` and `-q`.
void add_execute_options(CLI::App& command, ExecuteOptions& options);
/// Tells the findings; throws Error(recipe) if there is an error among them.
void require_ok(const RecipeResult& read, const std::string& what);
/// Says which input is taken, runs, and shows the progress.
RunResult execute(const Recipe& recipe, const Registry& registry, const std::filesystem::path& directory,
                  const ExecuteOptions& options);
/// 0; 4 if links were left out after errors; 130 if the user ended the search.
int exit_code_of(const RunResult& result);

} // namespace foam::cli
