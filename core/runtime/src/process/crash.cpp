#include "process/process.hpp"

#include <foam/base/internal/activity.hpp>
#include <foam/runtime/process.hpp>

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <climits>
#include <csignal>
#include <cstring>
#include <string>

namespace foam::inline runtime {

namespace {

/// The temporary name of a run directory, where a signal handler can read it.
struct FolderSlot {
    std::atomic<bool> taken{false}, complete{false};
    char path[PATH_MAX] = {};
};
std::array<FolderSlot, 16> folders; // of runs at the same time; a crash leaves further folders behind

std::array<struct sigaction, crash_signals.size()> handlers_before;
std::atomic_flag crashed = ATOMIC_FLAG_INIT;

void say(int descriptor, const char* text) {
    [[maybe_unused]] const auto written = write(descriptor, text, std::strlen(text));
}

void report(const char* crash) {
    const auto tell = [](const char* text) { say(STDERR_FILENO, text); };
    tell("\nfoam: crashed (");
    tell(crash);
    tell(") in ");
    const Activity* here = current_activity();
    const Activity* known = here ? here : active(0);
    if (here) {
        tell(text_of(*here).data());
        tell("\n");
    } else if (known) {
        tell("an unknown thread; active stages:\n");
        write_activities(STDERR_FILENO);
    } else {
        tell("no stage: a bug in foam; please report it\n");
    }
    tell("foam: the run directory is as it was before\n");
    if (known && remedy_of(*known) == CrashRemedy::remove_plugin) {
        tell("foam: remedy: remove that plugin; `foam plugins --why` tests each plugin in a child process\n");
    } else if (known) {
        tell("foam: remedy: `isolate: process` in the recipe (--set isolate=process) runs stages in child processes: a "
             "crash then affects one link, not the run\n");
    }
}

void on_crash(int signal, siginfo_t* info, void*) {
    if (crashed.test_and_set()) {
        for (;;) { // another thread already reports, and will end the process
            pause();
        }
    }
    for (std::size_t i = 0; i < crash_signals.size(); ++i) {
        if (crash_signals[i].number == signal) {
            report(crash_signals[i].text);
            remove_unfinished_runs();
            sigaction(signal, &handlers_before[i], nullptr);
        }
    }
    // On return the failed instruction runs again and ends the program. A signal that was sent is sent again.
    if (info->si_code <= 0) {
        raise(signal);
    }
}

} // namespace

int keep_for_crash(const std::filesystem::path& folder) {
    const std::string text = folder.string();
    for (std::size_t i = 0; i < folders.size() && text.size() < sizeof folders[i].path; ++i) {
        if (!folders[i].taken.exchange(true)) {
            std::memcpy(folders[i].path, text.c_str(), text.size() + 1);
            folders[i].complete.store(true);
            return static_cast<int>(i);
        }
    }
    return -1;
}

void forget_for_crash(int slot) {
    if (slot >= 0) {
        FolderSlot& taken = folders[static_cast<std::size_t>(slot)];
        taken.complete.store(false);
        taken.taken.store(false);
    }
}

void write_activities(int descriptor) {
    for (std::size_t i = 0; const Activity* activity = active(i); ++i) {
        say(descriptor, "  ");
        say(descriptor, text_of(*activity).data());
        say(descriptor, "\n");
    }
}

void remove_unfinished_runs() {
    for (FolderSlot& slot : folders) {
        if (!slot.complete.load()) {
            continue;
        }
        // To walk a folder needs memory, which a handler must not allocate: another program does it.
        const pid_t child = _Fork();
        if (child == 0) {
            char program[] = "/bin/rm", force[] = "-rf", end[] = "--";
            char* const arguments[] = {program, force, end, slot.path, nullptr};
            char* const environment[] = {nullptr};
            execve(program, arguments, environment);
            _exit(127);
        }
        if (child > 0) {
            waitpid(child, nullptr, 0);
        }
    }
}

void report_crashes() {
    provide_signal_stacks();
    struct sigaction action {};
    action.sa_sigaction = on_crash;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK;
    sigemptyset(&action.sa_mask);
    for (const CrashSignal& crash : crash_signals) {
        sigaddset(&action.sa_mask, crash.number);
    }
    for (std::size_t i = 0; i < crash_signals.size(); ++i) {
        sigaction(crash_signals[i].number, &action, &handlers_before[i]);
    }
}

} // namespace foam::runtime
