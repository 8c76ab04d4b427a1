// Completion of the command line in shells, made from the declared commands and options.
#pragma once

#include "described.hpp"

#include <string>
#include <vector>

namespace foam::cli {

/// Returns the shells that completion_script() knows: bash, zsh, fish.
const std::vector<std::string>& completion_shells();

/// Returns the script that completes commands, options, words of options and arguments, and file names. Throws
/// Error(usage) for another shell.
std::string completion_script(const DescribedProgram& program, const std::string& shell);

} // namespace foam::cli
