#include "program.hpp"

#include "files.hpp"
#include "messages.hpp"

#include <foam/base/error.hpp>
#include <foam/xml/document.hpp>

#include <fmt/format.h>

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <functional>

namespace foam::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 30; // the default limit of load.mesh
constexpr std::uintmax_t most_recipe_bytes = 1'000'000;        // that of a recipe's file
constexpr std::size_t enough_to_recognise = 65536;

/// Returns the bytes that are left of a file on the standard input; 0 for a pipe, which does not tell.
std::uintmax_t bytes_of_file() {
    struct stat file {};
    const off_t at = lseek(STDIN_FILENO, 0, SEEK_CUR);
    const bool known = at >= 0 && fstat(STDIN_FILENO, &file) == 0 && S_ISREG(file.st_mode) && file.st_size > at;
    return known ? static_cast<std::uintmax_t>(file.st_size - at) : 0;
}

/// Throws Error(input) for more than `most` bytes.
void require_at_most(std::uintmax_t most, std::uintmax_t bytes) {
    if (bytes > most) {
        throw Error(ErrorCode::input,
                    fmt::format("stdin: more than {} bytes; remedy: check that this is the input you mean", most));
    }
}

/// Reads the standard input piece by piece; a file that is too long is not read. Throws Error(input).
std::uintmax_t read_standard_input(std::uintmax_t most, const std::function<void(std::string_view)>& take) {
    require_at_most(most, bytes_of_file());
    std::array<char, 65536> buffer{};
    std::uintmax_t bytes = 0;
    while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), stdin)) {
        bytes += count;
        require_at_most(most, bytes);
        take({buffer.data(), count});
    }
    if (std::ferror(stdin) != 0) {
        throw Error(ErrorCode::input, "stdin: it cannot be read; remedy: pipe the input into foam, or name a file");
    }
    if (bytes == 0) {
        throw Error(ErrorCode::input, "stdin: it is empty; remedy: pipe the input into foam, or name a file");
    }
    return bytes;
}

std::string_view without_blanks(std::string_view text) {
    text.remove_prefix(text.starts_with("\xEF\xBB\xBF") ? 3 : 0);
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    return text;
}

bool is_binary_stl(std::string_view begin, std::uintmax_t size) {
    constexpr std::size_t header = 80, count_bytes = 4, triangle = 50;
    if (begin.size() < header + count_bytes) {
        return false;
    }
    std::uint32_t count = 0;
    for (std::size_t i = count_bytes; i-- > 0;) {
        count = count << 8U | static_cast<unsigned char>(begin[header + i]);
    }
    return size == header + count_bytes + std::uintmax_t{count} * triangle;
}

/// Returns whether the first line that is no comment is one of Wavefront's.
bool is_obj(std::string_view text) {
    text = without_blanks(text);
    while (text.starts_with('#')) {
        text.remove_prefix(std::min(text.find('\n'), text.size()));
        text = without_blanks(text);
    }
    const std::string_view word = text.substr(0, text.find_first_of(" \t"));
    constexpr std::array words{"v", "vn", "vt", "o", "g", "s", "mtllib", "usemtl"};
    return std::find(words.begin(), words.end(), word) != words.end();
}

} // namespace

std::string ending_of_content(std::string_view begin, std::uintmax_t size) {
    const std::string_view text = without_blanks(begin);
    if (text.starts_with('<')) {
        const std::string_view root = xml::root_name(text);
        return root == "robot" ? "urdf" : root == "mujoco" ? "xml" : root == "COLLADA" ? "dae" : "";
    }
    if (begin.starts_with("glTF")) {
        return "glb";
    }
    if (text.starts_with('{')) {
        return text.find("\"asset\"") != text.npos ? "gltf" : "";
    }
    if (begin.starts_with("ply\n") || begin.starts_with("ply\r")) {
        return "ply";
    }
    if (is_binary_stl(begin, size) || (text.starts_with("solid") && text.find("facet") != text.npos)) {
        return "stl";
    }
    const std::string_view word = text.substr(0, text.find_first_of(" \t\r\n"));
    if (word.size() <= 8 && word.ends_with("OFF")) {
        return "off";
    }
    return is_obj(text) ? "obj" : "";
}

void StandardInput::may_be(std::string& argument, Holds holds) {
    single_.push_back({&argument, holds});
}

void StandardInput::may_be(std::vector<std::string>& arguments, Holds holds) {
    several_.push_back({&arguments, holds});
}

void StandardInput::add_format(CLI::App& command) {
    command
        .add_option("--input-format", format_,
                    "Format of the input -, if its content does not show it: urdf, stl, obj, …")
        ->type_name("FORMAT");
}

void StandardInput::take() {
    std::vector<Single> given;
    const auto add = [&given](std::string& argument, Holds holds) {
        if (argument == "-") {
            given.push_back({&argument, holds});
        }
    };
    for (const Single& one : single_) {
        add(*one.argument, one.holds);
    }
    for (const Several& several : several_) {
        for (std::string& argument : *several.arguments) {
            add(argument, several.holds);
        }
    }
    if (given.size() > 1) {
        throw Error(ErrorCode::usage, "the standard input can be read once; remedy: one -, and files");
    }
    if (given.empty() && !format_.empty()) {
        throw Error(ErrorCode::usage, "--input-format is for the input -; remedy: without it");
    }
    if (!given.empty()) {
        store(*given.front().argument, given.front().holds);
    }
}

void StandardInput::store(std::string& argument, Holds holds) {
    folder_.emplace();
    const fs::path raw = folder_->path() / "stdin";
    std::string begin;
    std::ofstream stream(raw, std::ios::binary);
    const std::uintmax_t size = read_standard_input(most_bytes, [&](std::string_view piece) {
        begin += piece.substr(0, enough_to_recognise - std::min(begin.size(), enough_to_recognise));
        stream.write(piece.data(), static_cast<std::streamsize>(piece.size()));
    });
    stream.close();
    if (!stream) {
        throw Error(ErrorCode::output, fmt::format("cannot write to the folder {}; remedy: make room there, or set "
                                                   "TMPDIR",
                                                   folder_->path().string()));
    }
    const std::string ending = format_.empty() ? ending_of_content(begin, size) : format_;
    if (ending.empty() && holds == Holds::geometry) {
        throw Error(ErrorCode::input, "stdin: no format of robots or meshes is recognised in it; remedy: "
                                      "--input-format, such as --input-format stl");
    }
    fs::path file = raw;
    if (!ending.empty()) {
        file += "." + ending;
        fs::rename(raw, file);
    }
    file_ = argument = file.string();
    name_ = fs::current_path() / file.filename();
    show_as_standard_input({file_, name_.string()});
}

std::string named(const std::string& argument) {
    return argument == "-" ? "stdin" : argument;
}

RecipeResult read_recipe_argument(const std::string& file, Registry& registry, const std::vector<Setting>& settings,
                                  const std::vector<std::string>& variants) {
    if (file != "-") {
        return read_recipe(recipe_file(file), registry, settings, variants);
    }
    std::string text;
    read_standard_input(most_recipe_bytes, [&text](std::string_view piece) { text += piece; });
    return parse_recipe(text, named(file), registry, settings, variants);
}

} // namespace foam::cli
