// Processes that foam starts: a child that answers once, and one that lives on.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
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

/// A file descriptor that is closed at the end and not inherited. Its number is above those that a child gets.
class Descriptor {
public:
    /// Takes over `descriptor`. Throws Error(internal) naming `what` if it is negative: the system call that made it
    /// failed.
    Descriptor(int descriptor, const char* what);
    ~Descriptor();
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int value() const { return value_; }
    void close();

private:
    int value_ = -1;
};

/// Both ends of a pipe.
class Pipe {
public:
    /// Throws Error(internal) if no pipe can be made.
    Pipe();
    Descriptor reading, writing;

private:
    explicit Pipe(const int (&ends)[2]);
};

/// Returns a descriptor of a file in memory with the content `bytes`, positioned at its beginning.
int memory_file(std::string_view bytes);

/// A started process, the leader of its own process group. Its destructor kills the group and reaps the process.
class ChildProcess {
public:
    /// Starts `program command`. The child gets `request` as its standard input, `answers` as answer_descriptor and
    /// `errors` as its standard output and error, because stdout is for foam's data alone; it inherits no other
    /// descriptor. Throws Error(internal) if no process can be started.
    ChildProcess(const std::filesystem::path& program, const char* command, int request, int answers, int errors);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Returns whether the process has ended.
    bool ended();
    /// Returns how it ended. Only after ended().
    ChildEnd end() const;

private:
    pid_t id_ = 0;
    std::optional<int> status_;
};

/// Does what a child does first. The kernel ends it with the thread of `parent` that started it; it leaves no core
/// files; its private memory is limited to `mebibytes` (0: no limit), above which operator new throws. It ignores
/// SIGINT: Ctrl-C in a terminal also reaches the children, but is meant for the parent.
void begin_child(std::int64_t parent, std::uint64_t mebibytes);

} // namespace runtime
} // namespace foam
