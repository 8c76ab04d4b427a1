// Programs of others that stages run.
#pragma once

#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] base {

/// What a program did.
struct ProgramResult {
    int error = 0;      ///< errno of a program that could not be started; 0: it ran
    int status = 0;     ///< its exit status; 128 and the signal that ended it
    std::string output; ///< what it wrote to standard output
    std::string errors; ///< and to standard error
};

/// Runs a program to its end, without input. `words`: its name, looked up in PATH, and its arguments. Kills it if the work
/// is cancelled. Throws Error(output) if no temporary file can be made, Error(cancelled).
ProgramResult run_program(std::vector<std::string> words);

/// Returns the lines of a text that are not empty.
std::vector<std::string> lines_of(const std::string& text);
/// Returns the last lines of a program's messages, each on a line of its own after a line end, fit to be printed.
std::string last_lines(const std::string& errors);

} // namespace base
} // namespace foam
