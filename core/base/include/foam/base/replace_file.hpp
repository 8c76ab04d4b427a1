// Writes whole files: never half of one, and never in the place of a device.
#pragma once

#include <filesystem>
#include <string_view>
#include <system_error>

namespace foam {
inline namespace [[gnu::visibility("default")]] base {

/// Returns whether something exists there that is neither a file nor a folder, such as a device, a pipe or
/// /dev/stdout: what is written goes into it, and does not replace it.
bool is_special_file(const std::filesystem::path& file);

/// Returns where symbolic links lead in the end, whether something exists there or not; the path itself if it is none.
/// `error`: what went wrong.
std::filesystem::path followed(const std::filesystem::path& file, std::error_code& error);

/// Writes to a temporary name in the same folder, then renames. A symbolic link stays, and the file that it names is
/// replaced. A special file is written to. Returns what went wrong.
std::error_code replace_file(const std::filesystem::path& file, std::string_view bytes);

} // namespace base
} // namespace foam
