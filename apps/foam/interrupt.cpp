#include "interrupt.hpp"

#include <foam/host/crash.hpp>

#include <csignal>
#include <cstdio>
#include <unistd.h>

namespace foam::cli {
namespace {

// A signal handler can reach nothing but an object of static storage.
std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);
std::atomic<int> first_signal{0};
static_assert(std::atomic<int>::is_always_lock_free);
constexpr int exit_code_of_a_cut = 130;

void on_signal(int signal) {
    if (interrupted.exchange(true, std::memory_order_relaxed)) {
        remove_unfinished_runs();
        std::signal(signal, SIG_DFL);
        raise(signal);
        return;
    }
    first_signal.store(signal, std::memory_order_relaxed);
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

void end_on_termination() {
    struct sigaction action {};
    action.sa_handler = [](int) { _exit(exit_code_of_a_cut); };
    sigaction(SIGTERM, &action, nullptr);
}

int exit_code_after(int code) {
    const int signal = first_signal.load(std::memory_order_relaxed);
    if (signal == SIGINT) {
        std::fflush(nullptr);
        std::signal(SIGINT, SIG_DFL);
        raise(SIGINT);
    }
    return signal == 0 ? code : exit_code_of_a_cut;
}

} // namespace foam::cli
