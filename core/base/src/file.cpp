#include <foam/base/file.hpp>
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

/// Opens a regular file and calls read(descriptor, size, bytes), which returns how much it read, -1 on an error.
template <class Read>
FileContents read_by(const std::filesystem::path& file, std::uintmax_t most_bytes, std::string_view if_too_large,
                     Read read) {
    struct stat status {};
    if (stat(file.c_str(), &status) != 0) {
        return errno == ENOENT || errno == ENOTDIR ? problem("there is no such file", "check the path")
                                                   : cannot_be_read(errno);
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
    if (size > most_bytes) {
        return problem(fmt::format("it has {} bytes, more than {}", size, most_bytes), if_too_large);
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

FileContents read_regular_file(const std::filesystem::path& file, std::uintmax_t most_bytes,
                               std::string_view if_too_large) {
    return read_by(file, most_bytes, if_too_large, [](int descriptor, std::uintmax_t size, std::string& bytes) {
        bytes.resize(size);
        return read_up_to(descriptor, bytes.data(), size);
    });
}

FileContents read_regular_file(const std::filesystem::path& file, std::uintmax_t most_bytes,
                               std::string_view if_too_large, const std::function<void(std::string_view)>& take) {
    return read_by(file, most_bytes, if_too_large, [&](int descriptor, std::uintmax_t size, std::string&) {
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

} // namespace foam::base
