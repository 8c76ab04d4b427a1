// SIGINT and SIGTERM as a polite request to stop. The caller sees a cut.
#pragma once

#include <foam/base/cancellation.hpp>
#include <foam/runtime/run.hpp>

#include <atomic>

namespace foam::cli {

/// From now on SIGINT and SIGTERM set the flag that is returned; a second one ends the program at once. So does the
/// first if the program has not ended 2 s later.
const std::atomic<bool>& stop_on_interrupt();
/// Ends the program as one that the user has cut, if he has: by SIGINT itself, so that a shell's loop ends too, or,
/// after SIGTERM, with 130. Returns `code` otherwise. A later signal ends the program as any other program.
int exit_code_after(int code);

/// Whether one came.
bool interrupted();

/// The same for what works without a run: its loops ask the thread.
class InterruptRequest final : public StopRequest {
public:
    bool asked() const override { return interrupted(); }
};

/// Says what goes on although it was to end, and ends the program: nothing half-written is left.
[[noreturn]] void give_up(const Unresponsive& what);

} // namespace foam::cli
