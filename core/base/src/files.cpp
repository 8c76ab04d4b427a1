#include <foam/base/internal/files.hpp>

#include <foam/base/error.hpp>
#include <foam/base/file.hpp>

#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

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
    const auto fail = [&](const std::string& why) {
        throw Error(ErrorCode::output, fmt::format("{}: cannot be written: {}", file.string(), why));
    };
    std::error_code error;
    if (file.has_parent_path()) {
        fs::create_directories(file.parent_path(), error);
        if (error) {
            fail(error.message());
        }
    }
    const fs::path temporary = file.string() + fmt::format(".partial-{}", getpid());
    {
        std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
        stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        stream.close();
        if (!stream) {
            const std::string why = std::strerror(errno);
            fs::remove(temporary, error);
            fail(why);
        }
    }
    fs::rename(temporary, file, error);
    if (error) {
        std::error_code ignored;
        fs::remove(temporary, ignored);
        fail(error.message());
    }
}

} // namespace foam::inline base
