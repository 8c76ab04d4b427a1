#include "messages.hpp"

#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>

#include <fmt/format.h>
#include <zstd.h>

namespace foam::inline batch {
namespace {

constexpr int compression_level = 9;
constexpr unsigned long long most_frame_bytes = 1ULL << 30; ///< of a frame's text; foam's own hold some megabytes

/// Returns the text of the frame at the beginning of `bytes` and its length there; a length of 0 if it is not whole.
std::pair<std::string, std::size_t> frame_at(std::string_view bytes) {
    const std::size_t length = ZSTD_findFrameCompressedSize(bytes.data(), bytes.size());
    if (ZSTD_isError(length)) {
        return {"", 0};
    }
    const unsigned long long size = ZSTD_getFrameContentSize(bytes.data(), length);
    if (size > most_frame_bytes) { // includes "unknown" and "error"
        return {"", 0};
    }
    std::string text(size, '\0');
    const std::size_t got = ZSTD_decompress(text.data(), text.size(), bytes.data(), length);
    return got == size ? std::pair(std::move(text), length) : std::pair(std::string(), std::size_t{0});
}

} // namespace

std::string frame_of(std::string_view text) {
    std::string frame(ZSTD_compressBound(text.size()), '\0');
    const std::size_t size = ZSTD_compress(frame.data(), frame.size(), text.data(), text.size(), compression_level);
    if (ZSTD_isError(size)) {
        throw Error(ErrorCode::internal, fmt::format("zstd: {}", ZSTD_getErrorName(size)));
    }
    frame.resize(size);
    return frame;
}

std::size_t for_each_line(std::string_view bytes, const std::function<void(std::string_view)>& on_line) {
    std::size_t at = 0;
    while (at < bytes.size()) {
        const auto [text, length] = frame_at(bytes.substr(at));
        if (length == 0) {
            break;
        }
        for (std::size_t begin = 0; begin < text.size();) {
            const std::size_t end = std::min(text.find('\n', begin), text.size());
            on_line(std::string_view(text).substr(begin, end - begin));
            begin = end + 1;
        }
        at += length;
    }
    return at;
}

void for_each_line_of(const std::filesystem::path& file, const std::function<void(std::string_view)>& on_line) {
    const std::string bytes = read_file(file);
    if (for_each_line(bytes, on_line) != bytes.size()) {
        throw Error(ErrorCode::input,
                    fmt::format("{}: damaged or cut off; remedy: delete it, and run foam batch again", file.string()));
    }
}

} // namespace foam::batch
