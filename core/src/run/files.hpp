// Reading and writing whole files, with errors that name the file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace foam {

/// Throws Error(input).
std::string read_file(const std::filesystem::path& file);
/// Written to a temporary name beside it, then renamed: never half a file. Makes missing folders. Throws Error(output).
void write_file(const std::filesystem::path& file, std::string_view bytes);

} // namespace foam
