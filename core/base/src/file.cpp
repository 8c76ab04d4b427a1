#include <foam/base/file.hpp>

#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace foam::inline base {
namespace {

/// An open file, closed by the destructor.
class Descriptor {
public:
    /// Opens a file. O_NONBLOCK: the file may have been replaced by a pipe, which must not block.
    explicit Descriptor(const std::filesystem::path& file)
        : number_(open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC)) {}
    ~Descriptor() {
        if (number_ >= 0) {
            close(number_);
        }
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    int number() const { return number_; }

private:
    int number_;
};

FileContents problem(std::string what, std::string_view remedy) {
    return {"", std::move(what), std::string(remedy)};
}

FileContents not_regular(const struct stat& status) {
    const char* kind = S_ISDIR(status.st_mode)    ? "folder"
                       : S_ISFIFO(status.st_mode) ? "pipe"
                       : S_ISSOCK(status.st_mode) ? "socket"
                                                  : "device";
    return problem(fmt::format("it is a {}, not a regular file", kind), "give the path of a file");
}

FileContents cannot_be_read(int code) {
    return problem(fmt::format("it cannot be read ({})", std::strerror(code)), "check its permissions");
}

/// Reads up to `size` bytes into `target`. Returns their number, -1 on an error.
ssize_t read_up_to(int descriptor, char* target, std::size_t size) {
    std::size_t done = 0;
    while (done < size) {
        const ssize_t got = read(descriptor, target + done, size - done);
        if (got == 0) {
            break;
        }
        if (got < 0 && errno != EINTR) {
            return -1;
        }
        done += got > 0 ? static_cast<std::size_t>(got) : 0;
    }
    return static_cast<ssize_t>(done);
}

/// Returns that there is no such file, with the name in its folder that is spelled alike.
FileContents missing(const std::filesystem::path& file) {
    std::error_code error;
    std::vector<std::string> names;
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
    for (std::filesystem::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        names.push_back(it->path().filename().string());
    }
    std::sort(names.begin(), names.end());
    const std::string near = nearest_word(file.filename().string(), names);
    return problem("there is no such file",
                   near.empty() ? "check the path" : fmt::format("check the path; did you mean '{}'?", near));
}

/// Opens a regular file and calls read(descriptor, size, bytes), which returns how much it read, -1 on an error.
template <class Read>
FileContents read_by(const std::filesystem::path& file, std::uintmax_t most, std::string_view if_too_large, Read read) {
    struct stat status {};
    if (stat(file.c_str(), &status) != 0) {
        return errno == ENOENT || errno == ENOTDIR ? missing(file) : cannot_be_read(errno);
    }
    if (!S_ISREG(status.st_mode)) {
        return not_regular(status);
    }
    const Descriptor descriptor(file);
    if (descriptor.number() < 0 || fstat(descriptor.number(), &status) != 0) {
        return cannot_be_read(errno);
    }
    if (!S_ISREG(status.st_mode)) { // the file was replaced by something else
        return not_regular(status);
    }
    const auto size = static_cast<std::uintmax_t>(status.st_size);
    if (size > most) {
        return problem(fmt::format("it has {} bytes, more than {}", size, most), if_too_large);
    }
    FileContents result;
    const ssize_t got = read(descriptor.number(), size, result.bytes);
    if (got < 0) {
        return cannot_be_read(errno);
    }
    char more = 0;
    if (static_cast<std::uintmax_t>(got) != size || read_up_to(descriptor.number(), &more, 1) != 0) {
        return problem("it changed while it was read", "wait until it is written");
    }
    return result;
}

} // namespace

FileContents read_regular_file(const std::filesystem::path& file, std::uintmax_t most, std::string_view if_too_large) {
    return read_by(file, most, if_too_large, [](int descriptor, std::uintmax_t size, std::string& bytes) {
        bytes.resize(size);
        return read_up_to(descriptor, bytes.data(), size);
    });
}

FileContents read_regular_file(const std::filesystem::path& file, std::uintmax_t most, std::string_view if_too_large,
                               const std::function<void(std::string_view)>& take) {
    return read_by(file, most, if_too_large, [&](int descriptor, std::uintmax_t size, std::string&) {
        constexpr std::size_t at_once = std::size_t{1} << 18;
        std::string piece(std::min<std::uintmax_t>(at_once, size), '\0');
        ssize_t done = 0;
        while (static_cast<std::uintmax_t>(done) < size) {
            const auto left = std::min<std::uintmax_t>(piece.size(), size - static_cast<std::uintmax_t>(done));
            const ssize_t got = read_up_to(descriptor, piece.data(), left);
            if (got <= 0) {
                return got < 0 ? got : done;
            }
            take(std::string_view(piece).substr(0, static_cast<std::size_t>(got)));
            done += got;
        }
        return done;
    });
}

std::string extension_of(const std::filesystem::path& file) {
    const std::string extension = lower_case(file.extension().string());
    return extension.empty() ? "" : extension.substr(1);
}

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

void require_file(const fs::path& file) {
    const FileContents contents = read_by(file, std::numeric_limits<std::uintmax_t>::max(), "",
                                          [](int descriptor, std::uintmax_t size, std::string&) {
                                              lseek(descriptor, static_cast<off_t>(size), SEEK_SET);
                                              return static_cast<ssize_t>(size);
                                          });
    if (!contents.problem.empty()) {
        throw Error(ErrorCode::input, fmt::format("{}: {}", file.string(), contents.why_not()));
    }
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
