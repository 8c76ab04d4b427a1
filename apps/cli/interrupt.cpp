#include "messages.hpp"

#include "program.hpp"

#include <foam/base/error.hpp>
#include <foam/runtime/process.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <csignal>
#include <cstdio>
#include <cstring>
#include <unistd.h>

namespace foam::cli {
namespace {

constexpr unsigned time_to_stop = 2; // s

// A signal handler can reach nothing but an object of static storage.
std::atomic<bool> asked{false};
static_assert(std::atomic<bool>::is_always_lock_free);
std::atomic<int> first_signal{0};
static_assert(std::atomic<int>::is_always_lock_free);

void write_text(const char* text) {
    [[maybe_unused]] const auto written = write(STDERR_FILENO, text, std::strlen(text));
}

void on_signal(int signal) {
    if (asked.exchange(true, std::memory_order_relaxed)) {
        end_children();
        remove_unfinished_runs();
        std::signal(signal, SIG_DFL);
        raise(signal);
        return;
    }
    first_signal.store(signal, std::memory_order_relaxed);
    write_text("\nfoam: stopping; a second signal ends it at once\n");
    write_activities(STDERR_FILENO); // a stage that never asks whether to stop is named here
    alarm(time_to_stop);
}

/// What was asked to stop goes on. Runs have a watchdog of their own; this one is for commands and phases without a
/// run.
void on_alarm(int) {
    expect_end();
    write_text("foam: stopped; the program ends with these stages, which do not respond:\n");
    write_activities(STDERR_FILENO);
    end_children();
    remove_unfinished_runs();
    _exit(exit_code_after(exit_code(ErrorCode::cancelled)));
}

void handle(int signal, void (*handler)(int)) {
    struct sigaction action {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    sigaction(signal, &action, nullptr);
}

} // namespace

const std::atomic<bool>& stop_on_interrupt() {
    handle(SIGALRM, on_alarm);
    handle(SIGINT, on_signal);
    handle(SIGTERM, on_signal);
    return asked;
}

bool interrupted() {
    return asked.load(std::memory_order_relaxed);
}

void give_up(const Unresponsive& what) {
    const bool stop = what.asked == Cut::stop;
    tell(fmt::format("{} {:.1f} s after the start it still works on {}; nothing was written; remedy: {}",
                     stop ? "stopped:" : "error: the time limit is over, but", what.seconds,
                     what.at.empty() ? "work outside of the stages" : fmt::format("{}", fmt::join(what.at, "; ")),
                     "isolate: process for that stage (--set isolate=process), which ends with its process"));
    expect_end();
    end_children();
    remove_unfinished_runs();
    _exit(stop ? exit_code_after(exit_code(ErrorCode::cancelled)) : exit_code(ErrorCode::geometry));
}

int exit_code_after(int code) {
    // Nothing is left to stop. What comes from here on ends the program at once, and it does not say that it stops.
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    const int signal = first_signal.load(std::memory_order_relaxed);
    if (signal == SIGINT) {
        raise(SIGINT);
    }
    return signal == 0 ? code : exit_code(ErrorCode::cancelled);
}

} // namespace foam::cli
