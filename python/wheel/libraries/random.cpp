// Random numbers of the system for Debian's static Expat and libarchive and for libzip, which call functions that glibc has
// from 2.36 on alone.
#include <sys/random.h>

#include <cerrno>
#include <cstdint>
#include <cstdlib>

extern "C" {

__attribute__((visibility("hidden"))) void arc4random_buf(void* bytes, size_t size) {
    auto* next = static_cast<char*>(bytes);
    while (size > 0) {
        const ssize_t got = getrandom(next, size, 0);
        if (got < 0 && errno != EINTR) {
            std::abort(); // as glibc does: there is no number that nobody can guess
        }
        if (got > 0) {
            next += got;
            size -= static_cast<size_t>(got);
        }
    }
}

__attribute__((visibility("hidden"))) std::uint32_t arc4random() {
    std::uint32_t number = 0;
    arc4random_buf(&number, sizeof number);
    return number;
}
}
