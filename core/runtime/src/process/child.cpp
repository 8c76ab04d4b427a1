#include <foam/runtime/internal/child.hpp>

#include "process/process.hpp"

#include <foam/base/error.hpp>
#include <foam/runtime/process.hpp>

#include <fmt/format.h>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <string>

namespace foam::inline runtime {
namespace {

using Clock = std::chrono::steady_clock;

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
    Pipe answers;
    fcntl(answers.reading.value(), F_SETFL, O_NONBLOCK);

    const auto begin = Clock::now();
    ChildProcess child(program, child_command, question.value(), answers.writing.value(), STDERR_FILENO);
    answers.writing.close();
    Messages messages;
    for (bool open = true;;) {
        constexpr int tick = 50; // ms
        pollfd ready{answers.reading.value(), POLLIN, 0};
        if (poll(open ? &ready : nullptr, open ? 1 : 0, open ? tick : 1) > 0) {
            open = messages.read_from(answers.reading.value());
        } else if (child.ended()) { // everything that it wrote is in the pipe
            while (open && poll(&ready, 1, 0) > 0) {
                open = messages.read_from(answers.reading.value());
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
