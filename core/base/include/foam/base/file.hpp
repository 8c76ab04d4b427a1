// Files: their text, written whole or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <system_error>

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

/// Reads a regular file of at most `most` bytes; it checks the size before reading. It refuses folders, pipes and
/// devices without waiting for them, and a file whose size changes while it is read. `if_too_large`: the remedy for a
/// file above `most` bytes.
FileContents read_regular_file(const std::filesystem::path& file, std::uintmax_t most, std::string_view if_too_large);

/// Reads the same piece by piece, so that a large file takes no memory: calls take(bytes) in order. `bytes` of the
/// result stays empty.
FileContents read_regular_file(const std::filesystem::path& file, std::uintmax_t most, std::string_view if_too_large,
                               const std::function<void(std::string_view)>& take);

/// Returns a file's extension without its dot, in lower case (ASCII); empty if there is none. Stages declare theirs so.
std::string extension_of(const std::filesystem::path& file);

/// Returns whether something exists there that is neither a file nor a folder, such as a device, a pipe or
/// /dev/stdout: what is written goes into it, and does not replace it.
bool is_special_file(const std::filesystem::path& file);

/// Returns where symbolic links lead in the end, whether something exists there or not; the path itself if it is none.
/// `error`: what went wrong.
std::filesystem::path followed(const std::filesystem::path& file, std::error_code& error);

/// Writes to a temporary name in the same folder, then renames. A symbolic link stays, and the file that it names is
/// replaced. A special file is written to. Returns what went wrong.
std::error_code replace_file(const std::filesystem::path& file, std::string_view bytes);
/// Throws Error(input) naming the file, and the nearest name there is, for what is no regular file.
void require_file(const std::filesystem::path& file);

} // namespace base
} // namespace foam
