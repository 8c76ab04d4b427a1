// How the program begins and ends, whatever its caller left open and whatever its stages do.
#pragma once

namespace foam::cli {

/// Opens /dev/null in the place of each standard stream that the caller has closed: else the next file that is opened
/// would take its number, and messages would go into it.
void open_closed_streams();

/// Installs a guard: if a stage calls exit(), quick_exit() or _exit(), the program names it, removes the unfinished run
/// directory and ends with the exit code of a plugin's fault. For the whole process; call it once.
void report_ends_by_stages();
/// Removes that guard: the program itself is about to end. Safe in a signal handler.
void expect_end();

} // namespace foam::cli
