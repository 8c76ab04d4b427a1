// Crash reports: which stage, link and input the program worked on.
#pragma once

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

} // namespace runtime
} // namespace foam
