// Processes: what a program does first so that stages may run in others, and what a crash leaves behind.
#pragma once

#include <filesystem>
#include <string>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

/// Installs handlers for crashes (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT) of any thread. A handler names on stderr
/// what the thread worked on and what to do, and removes the unfinished run directory. It then ends the program by the
/// same signal, after the handler that was installed before. For the whole process; call it once, in main().
void report_crashes();

/// Writes the current activities to a file descriptor, one "  stage '…', link '…'" per line. Safe in a signal handler.
void write_activities(int descriptor);
/// Removes the folders of unfinished runs. Only for a process that is about to end; safe in a signal handler.
void remove_unfinished_runs();

/// Kills the processes in which isolated stages run. Only for a process that is about to end; safe in a signal handler.
void end_children();

/// Runs one call of an isolated stage and never returns, if the command line says that this process was started for
/// that; otherwise does nothing. It must be the first statement of main() of a program that runs recipes.
void serve_isolated_call(int count, char** arguments);

/// Loads a plugin in a child process of `program`. Returns an empty text if the process survives, else what happened
/// and what to do: a crash, or no end within `seconds`. It ignores whether the loader accepts the plugin.
std::string why_loading_ends_badly(const std::filesystem::path& program, const std::filesystem::path& plugin,
                                   double seconds = 60);

} // namespace runtime
} // namespace foam
