// A child process that answers in messages, and ends when it should.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace foam {

/// The word that follows the program's name on the command line of a child, and the descriptor that it answers on.
inline constexpr const char* child_command = "isolated-call";
inline constexpr int answer_descriptor = 3;

struct ChildLimits {
    std::optional<double> seconds;
    std::function<bool()> cancelled; ///< asked some twenty times a second; absent: never
};

struct ChildEnd {
    enum class Why { answered, exited, signalled, too_long, cancelled };
    Why why = Why::exited;
    int number = 0; ///< exit code or signal
};

/// Starts `program isolated-call` with `request` on its standard input and hands every message that it sends to
/// `on_message`, until that returns true (answered) or the child ends. The child, and whatever it has started in its
/// process group, is dead when this returns. Throws Error(internal) if no process can be started.
ChildEnd run_child(const std::filesystem::path& program, std::string_view request, const ChildLimits& limits,
                   const std::function<bool(std::string_view message)>& on_message);

/// Children that run now, of all threads.
std::size_t running_children();

/// "SIGSEGV, invalid memory access or stack overflow"
std::string signal_text(int signal);

} // namespace foam
