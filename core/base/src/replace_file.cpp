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

std::error_code last_error() {
    return {errno, std::generic_category()};
}

/// Writes all bytes to the open file; `safely`: waits until they are on the disk. Returns what went wrong.
std::error_code write_all(int descriptor, std::string_view bytes, bool safely) {
    while (!bytes.empty()) {
        const ssize_t written = write(descriptor, bytes.data(), bytes.size());
        if (written > 0) {
            bytes.remove_prefix(static_cast<std::size_t>(written));
        } else if (written < 0 && errno != EINTR) {
            return last_error();
        }
    }
    return safely && fsync(descriptor) != 0 ? last_error() : std::error_code();
}

/// Writes the bytes to the file that `flags` open. Returns what went wrong.
std::error_code write_to(const fs::path& file, std::string_view bytes, int flags, bool safely) {
    const int descriptor = open(file.c_str(), O_WRONLY | O_CLOEXEC | flags, 0666);
    if (descriptor < 0) {
        return last_error();
    }
    const std::error_code problem = write_all(descriptor, bytes, safely);
    return close(descriptor) != 0 && !problem ? last_error() : problem;
}

/// Writes the bytes to a new file. It gets its name once it is whole, so that nothing is left of a process that is
/// killed; where the file system cannot do so, the file has its name from the beginning.
std::error_code write_new(const fs::path& file, std::string_view bytes, bool safely) {
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    const int descriptor = open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor < 0) {
        return write_to(file, bytes, O_CREAT | O_TRUNC, safely);
    }
    std::error_code problem = write_all(descriptor, bytes, safely);
    if (!problem) {
        unlink(file.c_str()); // of a process that was killed and had the same number
        const std::string unnamed = fmt::format("/proc/self/fd/{}", descriptor);
        if (linkat(AT_FDCWD, unnamed.c_str(), AT_FDCWD, file.c_str(), AT_SYMLINK_FOLLOW) != 0) {
            problem = write_to(file, bytes, O_CREAT | O_TRUNC, safely);
        }
    }
    return close(descriptor) != 0 && !problem ? last_error() : problem;
}

/// Waits until the folder's names are on the disk. Some file systems cannot do so; then the names follow later.
void keep_names(const fs::path& folder) {
    const int descriptor = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor >= 0) {
        fsync(descriptor);
        close(descriptor);
    }
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
    error = write_new(temporary, bytes, replaces);
    if (!error) {
        fs::rename(temporary, target, error);
    }
    if (!error && replaces) {
        keep_names(target.parent_path());
    }
    if (error) {
        std::error_code ignored;
        fs::remove(temporary, ignored);
    }
    return error;
}

} // namespace foam::inline base
