// The signals that end a program, in words.
#pragma once

#include <array>
#include <csignal>

namespace foam::inline runtime {

struct CrashSignal {
    int number;
    const char* text;
};

/// Signals that a program raises by its own faults.
inline constexpr std::array<CrashSignal, 5> crash_signals{
    {{SIGSEGV, "SIGSEGV, invalid memory access or stack overflow"},
     {SIGBUS, "SIGBUS, invalid memory access"},
     {SIGFPE, "SIGFPE, invalid arithmetic"},
     {SIGILL, "SIGILL, invalid instruction"},
     {SIGABRT, "SIGABRT, the program aborted"}}};

} // namespace foam::runtime
