// Ctrl-C: the first asks the run to stop, the second ends the program at once. Either way the caller sees a cut.
#pragma once

#include <atomic>

namespace foam::cli {

/// From now on SIGINT and SIGTERM set the flag that is returned.
const std::atomic<bool>& stop_on_interrupt();
/// Makes SIGTERM end the program with the exit code of a cut (130) until stop_on_interrupt() is called. SIGINT has its
/// default until then: the program dies by it.
void end_on_termination();
/// Ends the program as one that the user has cut, if he has: by SIGINT itself, so that a shell's loop ends too, or,
/// after SIGTERM, with 130. Returns `code` otherwise.
int exit_code_after(int code);

} // namespace foam::cli
