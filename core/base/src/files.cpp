#include <foam/base/internal/files.hpp>

#include <foam/base/error.hpp>
#include <foam/base/file.hpp>
#include <foam/base/replace_file.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline base {
namespace fs = std::filesystem;

std::string read_file(const fs::path& file, std::uintmax_t most, std::string_view if_too_large) {
    FileContents contents = read_regular_file(file, most, if_too_large);
    if (!contents.problem.empty()) {
        throw Error(ErrorCode::input, fmt::format("{}: {}", file.string(), contents.why_not()));
    }
    return std::move(contents.bytes);
}

DigestedFile digest_of_file(const fs::path& file, std::uintmax_t most, std::string_view if_too_large) {
    Hasher hasher;
    std::size_t bytes = 0;
    const FileContents contents = read_regular_file(file, most, if_too_large, [&](std::string_view piece) {
        hasher.bytes(piece.data(), piece.size());
        bytes += piece.size();
    });
    if (!contents.problem.empty()) {
        throw Error(ErrorCode::input, fmt::format("{}: {}", file.string(), contents.why_not()));
    }
    return {hasher.finish(), bytes};
}

bool is_within_folder(const fs::path& relative) {
    return relative.is_relative() && relative.has_filename() &&
           std::find(relative.begin(), relative.end(), "..") == relative.end();
}

void write_file(const fs::path& file, std::string_view bytes) {
    std::error_code error;
    if (file.has_parent_path()) {
        fs::create_directories(file.parent_path(), error);
    }
    if (!error) {
        error = replace_file(file, bytes);
    }
    if (error) {
        throw Error(ErrorCode::output, fmt::format("{}: cannot be written: {}", file.string(), error.message()));
    }
}

} // namespace foam::inline base
