#include <foam/runtime/internal/child.hpp>

#include "signals.hpp"

#include <foam/base/error.hpp>
#include <foam/runtime/crash.hpp>

#include <fmt/format.h>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <string>

namespace foam::inline runtime {
namespace {

using Clock = std::chrono::steady_clock;

std::atomic<std::size_t> running{0};

// Process groups of the children, where a signal handler can read them. If more children than this run at once, the
// others survive a sudden end of the program until the kernel sees that their parent is gone.
std::array<std::atomic<pid_t>, 256> groups;

void remember(pid_t group) {
    for (auto& slot : groups) {
        pid_t none = 0;
        if (slot.compare_exchange_strong(none, group)) {
            return;
        }
    }
}

void forget(pid_t group) {
    for (auto& slot : groups) {
        pid_t expected = group;
        if (slot.compare_exchange_strong(expected, 0)) {
            return;
        }
    }
}

[[noreturn]] void fail(const char* what, int error) {
    throw Error(ErrorCode::internal,
                fmt::format("no child process for an isolated stage: {}: {}", what, std::strerror(error)));
}

/// A file descriptor that is closed at the end and not inherited. Its number is above those that a child gets.
class Descriptor {
public:
    Descriptor(int descriptor, const char* what) {
        if (descriptor < 0) {
            fail(what, errno);
        }
        value_ = fcntl(descriptor, F_DUPFD_CLOEXEC, answer_descriptor + 1);
        const int error = errno;
        ::close(descriptor);
        if (value_ < 0) {
            fail(what, error);
        }
    }
    ~Descriptor() { close(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int value() const { return value_; }
    void close() {
        if (value_ >= 0) {
            ::close(value_);
            value_ = -1;
        }
    }

private:
    int value_ = -1;
};

/// Returns a memory file with the content `bytes`, positioned at its beginning.
int memory_file(std::string_view bytes) {
    const int file = memfd_create("foam request", MFD_CLOEXEC);
    for (std::size_t done = 0; file >= 0 && done < bytes.size();) {
        const ssize_t n = write(file, bytes.data() + done, bytes.size() - done);
        if (n < 0 && errno != EINTR) {
            const int error = errno;
            close(file);
            fail("the request", error);
        }
        done += n > 0 ? static_cast<std::size_t>(n) : 0;
    }
    if (file >= 0) {
        lseek(file, 0, SEEK_SET);
    }
    return file;
}

/// A started process. Its destructor kills the process group and reaps the process.
class Process {
public:
    Process(const std::filesystem::path& program, int request, int answers) {
        posix_spawn_file_actions_t files;
        posix_spawnattr_t attributes;
        posix_spawn_file_actions_init(&files);
        posix_spawnattr_init(&attributes);
        posix_spawn_file_actions_adddup2(&files, request, STDIN_FILENO);
        posix_spawn_file_actions_adddup2(&files, answers, answer_descriptor);
        posix_spawn_file_actions_adddup2(&files, STDERR_FILENO, STDOUT_FILENO); // stdout is for foam's data alone
        posix_spawn_file_actions_addclosefrom_np(&files, answer_descriptor + 1);
        posix_spawnattr_setpgroup(&attributes, 0);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
        std::string name = program.string(), command = child_command;
        char* arguments[] = {name.data(), command.data(), nullptr};
        const int error = posix_spawn(&id_, name.c_str(), &files, &attributes, arguments, environ);
        posix_spawn_file_actions_destroy(&files);
        posix_spawnattr_destroy(&attributes);
        if (error != 0) {
            fail(name.c_str(), error);
        }
        ++running;
        remember(id_);
    }
    ~Process() {
        kill_group();
        forget(id_);
        while (!status_ && waitpid(id_, nullptr, 0) < 0 && errno == EINTR) {
        }
        --running;
    }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    /// Returns whether the process has ended.
    bool ended() {
        int status = 0;
        if (!status_ && waitpid(id_, &status, WNOHANG) != 0) { // ended, or reaped elsewhere
            status_ = status;
        }
        return status_.has_value();
    }
    ChildEnd end() const {
        return WIFSIGNALED(*status_) ? ChildEnd{ChildEnd::Why::signalled, WTERMSIG(*status_)}
                                     : ChildEnd{ChildEnd::Why::exited, WEXITSTATUS(*status_)};
    }

private:
    void kill_group() const { kill(-id_, SIGKILL); }
    pid_t id_ = 0;
    std::optional<int> status_;
};

/// Splits a stream into messages: 8 bytes of length, then as many bytes.
class Messages {
public:
    /// Reads the available bytes. Returns false at the end of the stream.
    bool read_from(int descriptor) {
        char chunk[65536];
        const ssize_t n = read(descriptor, chunk, sizeof chunk);
        if (n > 0) {
            buffer_.append(chunk, static_cast<std::size_t>(n));
        }
        return n > 0 || (n < 0 && (errno == EINTR || errno == EAGAIN));
    }
    /// Delivers complete messages until `on_message` returns true. Returns whether it did.
    bool deliver(const std::function<bool(std::string_view)>& on_message) {
        std::size_t at = 0;
        bool content = false;
        while (!content && buffer_.size() - at >= sizeof(std::uint64_t)) {
            std::uint64_t size = 0;
            std::memcpy(&size, buffer_.data() + at, sizeof size);
            if (buffer_.size() - at - sizeof size < size) {
                break;
            }
            content = on_message(std::string_view(buffer_).substr(at + sizeof size, size));
            at += sizeof size + size;
        }
        buffer_.erase(0, at);
        return content;
    }

private:
    std::string buffer_;
};

} // namespace

ChildEnd run_child(const std::filesystem::path& program, std::string_view request, const ChildLimits& limits,
                   const std::function<bool(std::string_view)>& on_message) {
    const Descriptor question(memory_file(request), "a file in memory");
    int ends[2] = {-1, -1};
    if (pipe2(ends, O_CLOEXEC) != 0) {
        fail("a pipe", errno);
    }
    const Descriptor answers(ends[0], "a pipe");
    Descriptor writing(ends[1], "a pipe");
    fcntl(answers.value(), F_SETFL, O_NONBLOCK);

    const auto begin = Clock::now();
    Process child(program, question.value(), writing.value());
    writing.close();
    Messages messages;
    for (bool open = true;;) {
        constexpr int tick = 50; // ms
        pollfd ready{answers.value(), POLLIN, 0};
        if (poll(open ? &ready : nullptr, open ? 1 : 0, open ? tick : 1) > 0) {
            open = messages.read_from(answers.value());
        } else if (child.ended()) { // everything that it wrote is in the pipe
            while (open && poll(&ready, 1, 0) > 0) {
                open = messages.read_from(answers.value());
            }
            open = false;
        }
        if (messages.deliver(on_message)) {
            return {ChildEnd::Why::answered};
        }
        if (!open && child.ended()) {
            return child.end();
        }
        if (limits.cancelled && limits.cancelled()) {
            return {ChildEnd::Why::cancelled};
        }
        if (limits.seconds && std::chrono::duration<double>(Clock::now() - begin).count() > *limits.seconds) {
            return {ChildEnd::Why::too_long};
        }
    }
}

void end_children() {
    for (const auto& slot : groups) {
        if (const pid_t group = slot.load(); group > 0) {
            kill(-group, SIGKILL);
        }
    }
}

std::size_t running_children() {
    return running.load(std::memory_order_relaxed);
}

std::string signal_text(int signal) {
    for (const CrashSignal& crash : crash_signals) {
        if (crash.number == signal) {
            return crash.text;
        }
    }
    if (signal == SIGKILL) {
        return "SIGKILL, from another program or for want of memory";
    }
    const char* name = sigabbrev_np(signal);
    return name ? fmt::format("SIG{}", name) : fmt::format("signal {}", signal);
}

} // namespace foam::runtime
