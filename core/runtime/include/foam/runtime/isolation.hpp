// Stages in child processes: the part of a program that runs recipes.
#pragma once

#include <filesystem>
#include <string>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

/// Runs one call of an isolated stage and never returns, if the command line says that this process was started for
/// that; otherwise does nothing. It must be the first statement of main() of a program that runs recipes.
void serve_isolated_call(int count, char** arguments);

/// Loads a plugin in a child process of `program`. Returns an empty text if the process survives, else what happened
/// and what to do: a crash, or no end within `seconds`. It ignores whether the loader accepts the plugin.
std::string why_loading_ends_badly(const std::filesystem::path& program, const std::filesystem::path& plugin,
                                   double seconds = 60);

} // namespace runtime
} // namespace foam
