// What a program of foam does around its commands.
#pragma once

#include "program.hpp"

#include <functional>

namespace foam::cli {

/// Reads the command line, runs the command that it names, reports errors, and returns the exit code. A call as the
/// child process of an isolated stage does not return.
int run_main(int count, char** arguments, const std::function<void(Program&)>& add_commands);

} // namespace foam::cli
