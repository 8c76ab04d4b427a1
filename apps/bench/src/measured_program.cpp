#include "measured_program.hpp"

#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
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
    while (wait4(id, &status, 0, &used) < 0 && errno == EINTR) {
    }
    MeasuredProgram result;
    result.cpu_seconds = seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
    result.memory = 1024.0 * static_cast<double>(used.ru_maxrss);
    result.over_limit = WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL);
    result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    result.output = read_file(output);
    result.errors = read_file(errors);
    return result;
}

} // namespace foam::bench::experiment
