// Reading and writing of whole files, with errors that name the file.
#pragma once

#include <foam/base/internal/digest.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace foam {
inline namespace [[gnu::visibility("default")]] base {

/// The largest size in bytes of a robot's text (URDF, SRDF), and of a sphere model.
inline constexpr std::uintmax_t most_robot_bytes = 64'000'000, most_model_bytes = 256'000'000;
/// The largest size in bytes of any other file that is read whole.
inline constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 34;

/// Returns the content of a regular file of at most `most` bytes; a larger file is not read. Throws Error(input).
std::string read_file(const std::filesystem::path& file, std::uintmax_t most = most_bytes,
                      std::string_view if_too_large = "check that this is the file you mean");
/// The digest of a file's bytes, and their number.
struct DigestedFile {
    Digest digest;
    std::size_t bytes = 0;
};
/// Returns digest_of(read_file(…)) without keeping the file in memory. Errors as read_file().
DigestedFile digest_of_file(const std::filesystem::path& file, std::uintmax_t most = most_bytes,
                            std::string_view if_too_large = "check that this is the file you mean");
/// Calls replace_file(). Makes missing folders. Throws Error(output).
void write_file(const std::filesystem::path& file, std::string_view bytes);
/// Returns whether the path names a file in a folder that it is relative to, without "..".
bool is_within_folder(const std::filesystem::path& relative);

} // namespace base
} // namespace foam
