// A child process that answers in messages, within limits.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

/// The first argument on the command line of a child; the descriptor for its answers.
inline constexpr const char* child_command = "isolated-call";
inline constexpr int answer_descriptor = 3;

struct ChildLimits {
    std::optional<double> seconds;
    std::function<bool()> cancelled; ///< called about twenty times a second; empty: never cancelled
};

struct ChildEnd {
    enum class Why { answered, exited, signalled, too_long, cancelled };
    Why why = Why::exited;
    int number = 0; ///< exit code or signal
};

/// Starts `program isolated-call` with `request` on its standard input and passes every message to `on_message`, until
/// that returns true (answered) or the child ends. On return the child and everything in its process group are dead.
/// Throws Error(internal) if no process can be started.
ChildEnd run_child(const std::filesystem::path& program, std::string_view request, const ChildLimits& limits,
                   const std::function<bool(std::string_view message)>& on_message);

/// Returns the number of children that run now, over all threads.
std::size_t running_children();

/// Returns the signal in words: "SIGSEGV, invalid memory access or stack overflow"
std::string signal_text(int signal);

} // namespace runtime
} // namespace foam
