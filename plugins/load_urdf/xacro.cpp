#include "xacro.hpp"

#include <foam/base/error.hpp>
#include <foam/base/program.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <cstring>
#include <set>
#include <vector>

namespace foam::urdf {
namespace fs = std::filesystem;

/// Returns the command for a file.
static std::vector<std::string> command(const fs::path& file, const std::string& arguments) {
    std::vector<std::string> words{"xacro", fs::absolute(file).string()};
    for (std::string& argument : lines_of(arguments)) {
        if (argument.find(":=") == argument.npos) {
            throw Error(ErrorCode::usage,
                        fmt::format("an argument of xacro is NAME:=VALUE, got '{}'", shown(argument)));
        }
        words.push_back(std::move(argument));
    }
    return words;
}

std::string expanded_xacro(const fs::path& file, const std::string& arguments) {
    std::error_code none;
    if (!fs::is_regular_file(file, none)) {
        throw Error(ErrorCode::input, fmt::format("{}: xacro reads files; remedy: name a file", file.string()));
    }
    ProgramResult done = run_program(command(file, arguments));
    if (done.error != 0) {
        throw Error(ErrorCode::plugin,
                    fmt::format("{}: the program xacro cannot be started ({}); remedy: pip install xacro, or the "
                                "package xacro of ROS, and PATH with its folder",
                                file.string(), std::strerror(done.error)));
    }
    if (done.status != 0) {
        throw Error(ErrorCode::input, fmt::format("{}: xacro fails:{}", file.string(), last_lines(done.errors)));
    }
    return std::move(done.output);
}

std::vector<fs::path> included_by_xacro(const fs::path& file, const std::string& arguments) {
    std::vector<std::string> asking = command(file, arguments);
    asking.insert(asking.begin() + 1, "--deps");
    const ProgramResult done = run_program(std::move(asking));
    std::set<fs::path> files;
    for (const std::string_view word : words(done.output)) { // blanks in a path are not told from those between
        std::error_code none;
        if (const fs::path path(word); done.status == 0 && fs::is_regular_file(path, none)) {
            files.insert(fs::absolute(path).lexically_normal());
        }
    }
    return {files.begin(), files.end()};
}

} // namespace foam::urdf
