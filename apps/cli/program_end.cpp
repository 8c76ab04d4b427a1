#include "program.hpp"

#include <foam/base/error.hpp>
#include <foam/runtime/process.hpp>

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace foam::cli {
namespace {

// Handlers of exit() can reach nothing but an object of static storage.
std::atomic<bool> guarded_end{false};

[[noreturn]] void end_now(int code) {
    for (;;) {
        syscall(SYS_exit_group, code);
    }
}

void say_at_end(const char* text) {
    [[maybe_unused]] const auto written = write(STDERR_FILENO, text, std::strlen(text));
}

void end_by_stage() {
    if (!guarded_end.exchange(false)) {
        return;
    }
    say_at_end("\nfoam: error: a stage has ended the program; nothing was written; foam worked on:\n");
    write_activities(STDERR_FILENO);
    say_at_end("foam: remedy: correct the plugin, or `isolate: process` in the recipe (--set isolate=process): the end "
               "of a stage then affects one link, not the run\n");
    end_children();
    remove_unfinished_runs();
    end_now(exit_code(ErrorCode::plugin));
}

} // namespace

void open_closed_streams() {
    for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream) {
        if (fcntl(stream, F_GETFD) == -1) { // open() takes the least number that is free
            [[maybe_unused]] const int opened = open("/dev/null", O_RDWR);
        }
    }
}

void report_ends_by_stages() {
    std::atexit(end_by_stage);
    std::at_quick_exit(end_by_stage);
    guarded_end.store(true);
}

void expect_end() {
    guarded_end.store(false);
}

} // namespace foam::cli

// Instead of the C library's: _exit() calls no handler. Plugins find the program's functions first.
extern "C" [[gnu::visibility("default"), noreturn]] void _exit(int code) {
    foam::cli::end_by_stage();
    foam::cli::end_now(code);
}
extern "C" [[gnu::visibility("default"), noreturn]] void _Exit(int code) {
    _exit(code);
}
