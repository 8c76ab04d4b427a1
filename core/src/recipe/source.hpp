// The text of a recipe's file.
#pragma once

#include <filesystem>
#include <string>

namespace foam::reading {

/// Why it cannot be read, with the remedy; empty if it was read. A regular file of at most a megabyte, as check_text()
/// takes it.
std::string read_text(const std::filesystem::path& file, std::string& text);

} // namespace foam::reading
