#include <foam/base/internal/files.hpp>

#include <foam/base/error.hpp>
#include <foam/base/file.hpp>

#include <fmt/format.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

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

/// Writes all bytes to the file, which exists if `made` is not set. Returns what went wrong.
static std::error_code write_to(const fs::path& file, std::string_view bytes, int made) {
    const int descriptor = open(file.c_str(), O_WRONLY | O_CLOEXEC | made, 0666);
    int problem = descriptor < 0 ? errno : 0;
    while (problem == 0 && !bytes.empty()) {
        const ssize_t written = write(descriptor, bytes.data(), bytes.size());
        if (written > 0) {
            bytes.remove_prefix(static_cast<std::size_t>(written));
        } else if (written < 0 && errno != EINTR) {
            problem = errno;
        }
    }
    if (descriptor >= 0 && close(descriptor) != 0 && problem == 0) {
        problem = errno;
    }
    return {problem, std::generic_category()};
}

bool is_special_file(const fs::path& file) {
    std::error_code ignored;
    return fs::is_other(fs::status(file, ignored));
}

std::error_code replace_file(const fs::path& file, std::string_view bytes) {
    if (is_special_file(file)) {
        return write_to(file, bytes, 0);
    }
    std::error_code error;
    const fs::path target = fs::is_symlink(fs::symlink_status(file, error)) ? fs::weakly_canonical(file, error) : file;
    if (error && error != std::errc::no_such_file_or_directory) {
        return error;
    }
    const fs::path temporary = target.string() + fmt::format(".partial-{}", getpid());
    error = write_to(temporary, bytes, O_CREAT | O_TRUNC);
    if (!error) {
        fs::rename(temporary, target, error);
    }
    if (error) {
        std::error_code ignored;
        fs::remove(temporary, ignored);
    }
    return error;
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
