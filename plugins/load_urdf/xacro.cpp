#include "xacro.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <memory>
#include <spawn.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace foam::urdf {
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

/// Waits for the process, and ends it if the work is cancelled. Returns whether it ended well.
bool ended_well(pid_t process) {
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
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
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

std::string expanded_xacro(const std::filesystem::path& file, const std::string& arguments) {
    std::error_code none;
    if (!std::filesystem::is_regular_file(file, none)) {
        throw Error(ErrorCode::input, fmt::format("{}: xacro reads files; remedy: name a file", file.string()));
    }
    std::vector<std::string> words{"xacro", std::filesystem::absolute(file).string()};
    for (std::string& argument : lines_of(arguments)) {
        if (argument.find(":=") == argument.npos) {
            throw Error(ErrorCode::usage,
                        fmt::format("an argument of xacro is NAME:=VALUE, got '{}'", shown(argument)));
        }
        words.push_back(std::move(argument));
    }
    const Scratch out = scratch(), errors = scratch();
    pid_t process = 0;
    if (const int error = start(words, out.get(), errors.get(), process)) {
        throw Error(ErrorCode::plugin,
                    fmt::format("{}: the program xacro cannot be started ({}); remedy: pip install xacro, or the "
                                "package xacro of ROS, and PATH with its folder",
                                file.string(), std::strerror(error)));
    }
    const bool well = ended_well(process);
    std::string urdf = text_of(out.get());
    if (!well) {
        const std::vector<std::string> said = lines_of(text_of(errors.get()));
        std::string why;
        constexpr std::size_t most = 8; // lines
        for (std::size_t i = said.size() - std::min(said.size(), most); i < said.size(); ++i) {
            why += "\n  " + shown(said[i]);
        }
        throw Error(ErrorCode::input, fmt::format("{}: xacro fails:{}", file.string(), why));
    }
    return urdf;
}

} // namespace foam::urdf
