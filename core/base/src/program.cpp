#include <foam/base/program.hpp>

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/base/text.hpp>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <memory>
#include <spawn.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace foam::inline base {
namespace {

struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using Scratch = std::unique_ptr<std::FILE, Closer>; ///< a file without a name

Scratch scratch() {
    Scratch file(std::tmpfile());
    if (!file) {
        throw Error(ErrorCode::output, "no temporary file can be made; remedy: make room in the folder TMPDIR");
    }
    return file;
}

std::string text_of(std::FILE* file) {
    std::string text;
    std::rewind(file);
    char buffer[65536];
    while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, file)) {
        text.append(buffer, count);
    }
    return text;
}

/// Waits for the process, and ends it if the work is cancelled. Returns ProgramResult::status.
int awaited(pid_t process) {
    int status = 0;
    while (waitpid(process, &status, WNOHANG) == 0) {
        try {
            check_cancelled();
        } catch (...) {
            kill(process, SIGKILL);
            waitpid(process, &status, 0);
            throw;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Starts the program with its output in two files. Returns 0, or the number of the error.
int start(std::vector<std::string> words, std::FILE* out, std::FILE* errors, pid_t& process) {
    std::vector<char*> pointers;
    for (std::string& word : words) {
        pointers.push_back(word.data());
    }
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", 0, 0);
    posix_spawn_file_actions_adddup2(&files, fileno(out), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files, fileno(errors), STDERR_FILENO);
    const int error = posix_spawnp(&process, pointers.front(), &files, nullptr, pointers.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    return error;
}

} // namespace

ProgramResult run_program(std::vector<std::string> words) {
    const Scratch out = scratch(), errors = scratch();
    pid_t process = 0;
    ProgramResult result;
    result.error = start(std::move(words), out.get(), errors.get(), process);
    if (result.error == 0) {
        result.status = awaited(process);
        result.output = text_of(out.get());
        result.errors = text_of(errors.get());
    }
    return result;
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        if (end > at) {
            lines.push_back(text.substr(at, end - at));
        }
        at = end + 1;
    }
    return lines;
}

std::string last_lines(const std::string& errors) {
    constexpr std::size_t most = 8;
    const std::vector<std::string> said = lines_of(errors);
    std::string text;
    for (std::size_t i = said.size() - std::min(said.size(), most); i < said.size(); ++i) {
        text += "\n  " + shown(said[i]);
    }
    return text;
}

} // namespace foam::inline base
