// The last words of a program that crashes: which stage, link and input it was at work on.
#pragma once

namespace foam {

/// From now on a crash (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT) of any thread names on stderr what that thread worked
/// on and what to do, removes the unfinished run directory, and then ends the program by the same signal, after the
/// handler that was installed before. For the whole process; call it once, in main().
void report_crashes();

/// Writes what is at work to a file descriptor, one "  stage '…', link '…'" a line. Safe in a signal handler.
void write_activities(int descriptor);
/// Removes the folders of runs that are not finished. Only for a process that ends now; safe in a signal handler.
void remove_unfinished_runs();

/// Kills the processes in which isolated stages run. Only for a process that ends now; safe in a signal handler.
void end_children();

} // namespace foam
