#include "measured_program.hpp"

#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace foam::inline bench::experiment {
namespace {

namespace fs = std::filesystem;

double seconds_of(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

pid_t start(const fs::path& program, const std::vector<std::string>& arguments, const fs::path& output,
            const fs::path& errors) {
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    for (const auto& [descriptor, file] : {std::pair(STDOUT_FILENO, &output), {STDERR_FILENO, &errors}}) {
        posix_spawn_file_actions_addopen(&files, descriptor, file->c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    }
    std::vector<std::string> words{program.string()};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    std::transform(words.begin(), words.end(), std::back_inserter(pointers), [](std::string& w) { return w.data(); });
    pointers.push_back(nullptr);
    pid_t id = 0;
    const int error = posix_spawn(&id, program.c_str(), &files, nullptr, pointers.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    if (error != 0) {
        throw Error(ErrorCode::internal, fmt::format("{} cannot be started ({})", program.string(), std::strerror(error)));
    }
    return id;
}

/// Returns the most memory of a process that was resident so far, bytes; 0 if it has ended. The figure of wait4() would
/// not be less than that of this process, from which the child was started.
double most_resident(pid_t id) {
    std::ifstream status(fmt::format("/proc/{}/status", id));
    for (std::string word; status >> word;) {
        if (double kilobytes = 0; word == "VmHWM:" && status >> kilobytes) {
            return 1024 * kilobytes;
        }
    }
    return 0;
}

} // namespace

fs::path foam_program() {
    const fs::path program = fs::read_symlink("/proc/self/exe").parent_path() / "foam";
    if (!fs::exists(program)) {
        throw Error(ErrorCode::usage, fmt::format("{}: foam is not beside foam-bench; remedy: build or install both",
                                                  program.string()));
    }
    return program;
}

MeasuredProgram run_measured(const fs::path& program, const std::vector<std::string>& arguments, double cpu_limit,
                             const fs::path& scratch) {
    const fs::path output = scratch / "stdout", errors = scratch / "stderr";
    const pid_t id = start(program, arguments, output, errors);
    const auto limit = static_cast<rlim_t>(std::ceil(cpu_limit)) + 1;
    const rlimit cpu{limit, limit};
    prlimit(id, RLIMIT_CPU, &cpu, nullptr);
    int status = 0;
    rusage used{};
    double memory = 0;
    for (pid_t ended = 0; ended != id;) {
        constexpr auto between_looks = std::chrono::milliseconds(2);
        memory = std::max(memory, most_resident(id));
        std::this_thread::sleep_for(between_looks);
        ended = wait4(id, &status, WNOHANG, &used);
        if (ended < 0 && errno != EINTR) {
            throw Error(ErrorCode::internal, fmt::format("{} is lost ({})", program.string(), std::strerror(errno)));
        }
    }
    MeasuredProgram result;
    result.cpu_seconds = seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
    result.memory = memory;
    result.over_limit = WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL);
    result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    result.output = read_file(output);
    result.errors = read_file(errors);
    return result;
}

} // namespace foam::bench::experiment
