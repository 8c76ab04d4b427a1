#include "workers.hpp"

#include <foam/runtime/process.hpp>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace foam::fuzz {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// Fields of a message end with 0, messages with 1: neither is in a text for people.
std::string packed(std::string text) {
    for (char& c : text) {
        c = c == '\0' || c == '\1' ? '?' : c;
    }
    return text + '\0';
}

std::string message_of(std::uint64_t seed, const Outcome& outcome) {
    std::string message = packed(std::to_string(seed)) + packed(std::to_string(outcome.seconds)) +
                          packed(outcome.spherizer) + packed(outcome.end);
    for (const std::string& finding : outcome.findings) {
        message += packed(finding);
    }
    return message + '\1';
}

std::vector<std::string> fields_of(const std::string& message) {
    std::vector<std::string> fields;
    for (std::size_t at = 0; at < message.size();) {
        const std::size_t end = message.find('\0', at);
        fields.push_back(message.substr(at, end - at));
        at = end + 1;
    }
    return fields;
}

void send(int pipe, const std::string& message) {
    for (std::size_t sent = 0; sent < message.size();) {
        const ssize_t count = write(pipe, message.data() + sent, message.size() - sent);
        if (count <= 0) {
            _exit(3);
        }
        sent += static_cast<std::size_t>(count);
    }
}

/// User and system time of a process so far, s.
double cpu_seconds_of(pid_t process) {
    std::ifstream stream("/proc/" + std::to_string(process) + "/stat");
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    std::istringstream rest(text.substr(std::min(text.rfind(')') + 1, text.size())));
    std::vector<std::string> fields{std::istream_iterator<std::string>(rest), {}};
    const auto ticks = [&](std::size_t i) { return i < fields.size() ? std::stod(fields[i]) : 0; };
    return (ticks(11) + ticks(12)) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

class Worker {
public:
    Worker(std::vector<std::uint64_t> seeds, Registry& registry, fs::path folder, const Limits& limits)
        : seeds_(std::move(seeds)), registry_(registry), folder_(std::move(folder)), limits_(limits) {
        start();
    }
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;
    ~Worker() {
        if (process_ > 0) {
            kill(process_, SIGKILL);
            waitpid(process_, nullptr, 0);
            close(pipe_);
        }
        std::error_code ignored;
        fs::remove_all(folder_, ignored);
    }

    bool done() const { return process_ < 0; }
    int pipe() const { return pipe_; }

    /// Takes what the process has written; at its end what that was.
    void take(const Told& told) {
        char bytes[4096];
        const ssize_t count = read(pipe_, bytes, sizeof bytes);
        if (count > 0) {
            text_.append(bytes, static_cast<std::size_t>(count));
            for (std::size_t end; (end = text_.find('\1')) != std::string::npos;) {
                tell(text_.substr(0, end), told);
                text_.erase(0, end + 1);
            }
        } else if (count == 0) {
            end(told);
        }
    }

    /// Ends a process that takes too long: first so that it can say where it is.
    void watch() {
        const double wall = std::chrono::duration<double>(Clock::now() - begin_).count();
        const double cpu = cpu_seconds_of(process_) - cpu_begin_;
        if (!hung_ && (cpu > limits_.cpu_seconds || wall > 10 * limits_.cpu_seconds)) {
            hung_ = cpu;
            begin_ = Clock::now();
            kill(process_, SIGABRT);
        } else if (hung_ && wall > 3) {
            kill(process_, SIGKILL);
        }
    }

private:
    void start() {
        int ends[2];
        if (pipe2(ends, O_CLOEXEC) != 0) {
            throw std::runtime_error("no pipe");
        }
        fs::remove_all(folder_);
        fs::create_directories(folder_);
        process_ = fork();
        if (process_ < 0) {
            throw std::runtime_error("no process");
        }
        if (process_ == 0) {
            close(ends[0]);
            work(ends[1]);
        }
        close(ends[1]);
        pipe_ = ends[0];
        text_.clear();
        next_case();
    }

    void next_case() {
        begin_ = Clock::now();
        cpu_begin_ = cpu_seconds_of(process_);
        hung_.reset();
    }

    [[noreturn]] void work(int pipe) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        const int errors = open((folder_ / "stderr").c_str(), O_CREAT | O_TRUNC | O_WRONLY | O_APPEND, 0600);
        dup2(errors, STDERR_FILENO);
        const rlim_t bytes = limits_.memory == 0 ? RLIM_INFINITY : rlim_t{limits_.memory} << 20;
        const rlimit memory{bytes, bytes}, no_core{0, 0};
        setrlimit(RLIMIT_AS, &memory);
        setrlimit(RLIMIT_CORE, &no_core);
        report_crashes();
        for (std::size_t i = done_; i < seeds_.size(); ++i) {
            const fs::path folder = folder_ / "case";
            Outcome outcome;
            try {
                outcome = run_case(make_case(seeds_[i], registry_, limits_.cases), registry_, folder);
            } catch (const std::exception& error) {
                outcome.findings.push_back(std::string("the fuzzer itself: ") + error.what());
            }
            fs::remove_all(folder);
            send(pipe, message_of(seeds_[i], outcome));
        }
        _exit(0);
    }

    void tell(const std::string& message, const Told& told) {
        const std::vector<std::string> fields = fields_of(message);
        Outcome outcome;
        outcome.seconds = std::stod(fields.at(1));
        outcome.spherizer = fields.at(2);
        outcome.end = fields.at(3);
        outcome.findings.assign(fields.begin() + 4, fields.end());
        ++done_;
        next_case();
        told(seeds_[done_ - 1], outcome);
    }

    /// The lines that a crash or a sanitizer left, the telling ones.
    std::string last_words() const {
        std::ifstream stream(folder_ / "stderr");
        std::string words;
        for (std::string line; std::getline(stream, line);) {
            for (const char* word :
                 {"foam: crashed", "ERROR: ", "runtime error", "SUMMARY", "terminate", "    #1 ", "    #3 "}) {
                if (line.find(word) != std::string::npos && words.size() < 600) {
                    words += (words.empty() ? "" : " | ") + line;
                }
            }
        }
        return words;
    }

    void end(const Told& told) {
        int status = 0;
        rusage usage{};
        wait4(process_, &status, 0, &usage);
        close(pipe_);
        process_ = -1;
        if (done_ == seeds_.size() && WIFEXITED(status) && WEXITSTATUS(status) == 0) {
            return;
        }
        Outcome outcome;
        outcome.seconds = hung_.value_or(0);
        const std::string how = WIFSIGNALED(status) ? std::string("signal ") + strsignal(WTERMSIG(status))
                                                    : "exit code " + std::to_string(WEXITSTATUS(status));
        outcome.findings.push_back((hung_ ? "HANG: " : "CRASH: " + how + ": ") + last_words());
        told(seeds_[std::min(done_, seeds_.size() - 1)], outcome);
        ++done_;
        if (done_ < seeds_.size()) {
            start();
        }
    }

    std::vector<std::uint64_t> seeds_;
    Registry& registry_;
    fs::path folder_;
    Limits limits_;
    std::size_t done_ = 0;
    pid_t process_ = -1;
    int pipe_ = -1;
    std::string text_;
    Clock::time_point begin_;
    double cpu_begin_ = 0;
    std::optional<double> hung_; ///< s of CPU that it took until then
};

} // namespace

void run_cases(const std::vector<std::uint64_t>& seeds, Registry& registry, const fs::path& scratch,
               const Limits& limits, const Told& told) {
    std::vector<std::unique_ptr<Worker>> workers;
    std::size_t given = 0, started = 0;
    while (given < seeds.size() || !workers.empty()) {
        while (given < seeds.size() && workers.size() < limits.jobs) {
            const std::size_t count = std::min(limits.batch, seeds.size() - given);
            workers.push_back(std::make_unique<Worker>(
                std::vector<std::uint64_t>(seeds.begin() + static_cast<std::ptrdiff_t>(given),
                                           seeds.begin() + static_cast<std::ptrdiff_t>(given + count)),
                registry, scratch / ("worker" + std::to_string(started++)), limits));
            given += count;
        }
        std::vector<pollfd> pipes;
        for (const auto& worker : workers) {
            pipes.push_back({worker->pipe(), POLLIN, 0});
        }
        poll(pipes.data(), pipes.size(), 200);
        for (std::size_t i = 0; i < workers.size(); ++i) {
            if (pipes[i].revents != 0) {
                workers[i]->take(told);
            } else {
                workers[i]->watch();
            }
        }
        std::erase_if(workers, [](const auto& worker) { return worker->done(); });
    }
}

} // namespace foam::fuzz
