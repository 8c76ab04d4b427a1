#include <foam/base/replace_file.hpp>

#include <fmt/format.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace foam::inline base {
namespace fs = std::filesystem;
namespace {

/// Symbolic links that lead from one to the next, as in Linux.
constexpr int most_links = 40;

/// Writes all bytes to the file, which exists if `made` is not set; `safely`: waits until they are on the disk. Returns
/// what went wrong.
std::error_code write_to(const fs::path& file, std::string_view bytes, int made, bool safely) {
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
    if (problem == 0 && safely && fsync(descriptor) != 0) {
        problem = errno;
    }
    if (descriptor >= 0 && close(descriptor) != 0 && problem == 0) {
        problem = errno;
    }
    return {problem, std::generic_category()};
}

} // namespace

bool is_special_file(const fs::path& file) {
    std::error_code ignored;
    return fs::is_other(fs::status(file, ignored));
}

fs::path followed(const fs::path& file, std::error_code& error) {
    fs::path target = file;
    std::error_code ignored; // what is not there is no link
    error.clear();
    for (int links = 0; !error && fs::is_symlink(fs::symlink_status(target, ignored)); ++links) {
        if (links == most_links) {
            error = std::make_error_code(std::errc::too_many_symbolic_link_levels);
        } else {
            target = target.parent_path() / fs::read_symlink(target, error);
        }
    }
    return target;
}

std::error_code replace_file(const fs::path& file, std::string_view bytes) {
    if (is_special_file(file)) {
        return write_to(file, bytes, 0, false);
    }
    std::error_code error;
    const fs::path target = followed(file, error);
    if (error) {
        return error;
    }
    const fs::path temporary = target.string() + fmt::format(".partial-{}", getpid());
    // A crash after the rename must not leave an empty file where the old one was.
    const bool replaces = fs::exists(target, error);
    error = write_to(temporary, bytes, O_CREAT | O_TRUNC, replaces);
    if (!error) {
        fs::rename(temporary, target, error);
    }
    if (error) {
        std::error_code ignored;
        fs::remove(temporary, ignored);
    }
    return error;
}

} // namespace foam::inline base
