#include "interrupt.hpp"

#include <foam/host/crash.hpp>

#include <csignal>
#include <cstring>
#include <unistd.h>

namespace foam::cli {
namespace {

// A signal handler can reach nothing but an object of static storage.
std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void on_signal(int signal) {
    if (interrupted.exchange(true, std::memory_order_relaxed)) {
        remove_unfinished_runs();
        std::signal(signal, SIG_DFL);
        raise(signal);
        return;
    }
    constexpr char message[] = "\nfoam: stopping; once more ends it at once\n";
    [[maybe_unused]] const auto written = write(STDERR_FILENO, message, sizeof message - 1);
    write_activities(STDERR_FILENO); // a stage that never asks whether to stop is named here
}

} // namespace

const std::atomic<bool>& stop_on_interrupt() {
    struct sigaction action {};
    action.sa_handler = on_signal;
    action.sa_flags = SA_RESTART;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    return interrupted;
}

} // namespace foam::cli
