// The text of a recipe's file.
#pragma once

#include <filesystem>
#include <string>

namespace foam {
inline namespace [[gnu::visibility("default")]] recipe {
namespace reading {

/// Reads a regular file of at most a megabyte, the limit of check_text(). Returns why it cannot be read, with the
/// remedy; empty if it was read.
std::string read_text(const std::filesystem::path& file, std::string& text);

} // namespace reading
} // namespace recipe
} // namespace foam
