#include "xacro.hpp"

#include <foam/base/error.hpp>
#include <foam/base/program.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <cstring>
#include <vector>

namespace foam::urdf {

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
    ProgramResult done = run_program(std::move(words));
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

} // namespace foam::urdf
