// Stages in child processes: what a program that runs recipes does for them.
#pragma once

#include <filesystem>
#include <string>

namespace foam {

/// If the command line says that this process was started to run one call of an isolated stage, does that and never
/// returns; otherwise does nothing. The first statement of main() of a program that runs recipes.
void serve_isolated_call(int count, char** arguments);

/// Loads a plugin in a child process of `program`. Empty if it lives through that, else what became of it and what to
/// do: a crash, or no end within `seconds`. What the loader says of it is not looked at.
std::string why_loading_ends_badly(const std::filesystem::path& program, const std::filesystem::path& plugin,
                                   double seconds = 60);

} // namespace foam
