// Ctrl-C: the first asks the run to stop, the second ends the program at once.
#pragma once

#include <atomic>

namespace foam::cli {

/// From now on SIGINT and SIGTERM set the flag that is returned.
const std::atomic<bool>& stop_on_interrupt();

} // namespace foam::cli
