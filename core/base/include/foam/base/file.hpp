// Reads whole files of unknown size and kind.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace foam {
inline namespace [[gnu::visibility("default")]] base {

/// The contents of a file, or why it was not read.
struct FileContents {
    std::string bytes;
    std::string problem; ///< "there is no such file"; empty if it was read
    std::string remedy;  ///< "check the path"
    /// Returns "there is no such file; remedy: check the path"; empty if the file was read.
    std::string why_not() const { return problem.empty() ? "" : problem + "; remedy: " + remedy; }
};

/// Reads a regular file of at most `most_bytes`; it checks the size before reading. It refuses folders, pipes and
/// devices without waiting for them, and a file whose size changes while it is read. `if_too_large`: the remedy for a
/// file above `most_bytes`.
FileContents read_regular_file(const std::filesystem::path& file, std::uintmax_t most_bytes,
                               std::string_view if_too_large);

/// Reads the same piece by piece, so that a large file takes no memory: calls take(bytes) in order. `bytes` of the
/// result stays empty.
FileContents read_regular_file(const std::filesystem::path& file, std::uintmax_t most_bytes,
                               std::string_view if_too_large, const std::function<void(std::string_view)>& take);

/// Returns a file's extension without its dot, in lower case (ASCII); empty if there is none. Stages declare theirs so.
std::string extension_of(const std::filesystem::path& file);

} // namespace base
} // namespace foam
