#include <foam/base/error.hpp>
#include <foam/runtime/cache.hpp>
#include <foam/runtime/internal/cache.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <tuple>

namespace foam::inline runtime {
namespace fs = std::filesystem;
namespace {

constexpr std::uintmax_t mebibyte = 1024 * 1024, default_limit = 2048;

struct Entry {
    fs::path file;
    fs::file_time_type used;
    std::uintmax_t bytes;
};

/// Returns whether `file` has the form of Cache::file(): 2 hexadecimal digits / 30 of them.
bool is_entry(const fs::path& file) {
    const std::string folder = file.parent_path().filename().string(), name = file.filename().string();
    return folder.size() == 2 && name.size() == 30 &&
           (folder + name).find_first_not_of("0123456789abcdef") == std::string::npos;
}

std::vector<Entry> entries_of(const fs::path& folder) {
    std::vector<Entry> entries;
    std::error_code error;
    for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        std::error_code gone; // another process may trim at the same time
        if (!is_entry(it->path()) || !it->is_regular_file(gone)) {
            continue;
        }
        Entry entry{it->path(), it->last_write_time(gone), it->file_size(gone)};
        if (!gone) {
            entries.push_back(std::move(entry));
        }
    }
    return entries;
}

} // namespace

fs::path default_cache_folder() {
    return Cache::default_folder();
}

std::uintmax_t cache_limit() {
    const char* text = std::getenv("FOAM_CACHE_LIMIT");
    if (!text || !*text) {
        return default_limit * mebibyte;
    }
    const std::string_view digits = text;
    std::uintmax_t limit = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), limit);
    if (error != std::errc() || end != digits.data() + digits.size() || limit > UINTMAX_MAX / mebibyte) {
        throw Error(ErrorCode::usage,
                    fmt::format("FOAM_CACHE_LIMIT is '{}'; remedy: a whole number of MiB, 0 for no limit", digits));
    }
    return limit * mebibyte;
}

CacheContents cache_contents(const fs::path& folder) {
    CacheContents contents;
    for (const Entry& entry : entries_of(folder)) {
        contents.entries += 1;
        contents.bytes += entry.bytes;
    }
    return contents;
}

CacheContents trim_cache(const fs::path& folder, std::uintmax_t bytes) {
    std::vector<Entry> entries = entries_of(folder);
    std::uintmax_t left = 0;
    for (const Entry& entry : entries) {
        left += entry.bytes;
    }
    CacheContents deleted;
    if (left <= bytes) {
        return deleted;
    }
    std::sort(entries.begin(), entries.end(),
              [](const Entry& a, const Entry& b) { return std::tie(a.used, a.file) < std::tie(b.used, b.file); });
    for (const Entry& entry : entries) {
        std::error_code error;
        if (left <= bytes) {
            break;
        }
        if (fs::remove(entry.file, error)) {
            left -= entry.bytes;
            deleted.entries += 1;
            deleted.bytes += entry.bytes;
        }
    }
    return deleted;
}

} // namespace foam::runtime
