// Reading and writing whole files, with errors that name the file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace foam {

/// Most bytes of a robot's text (URDF, SRDF), and of a sphere model.
inline constexpr std::uintmax_t most_robot_bytes = 64'000'000, most_model_bytes = 256'000'000;
/// Most bytes of any other file that is read whole.
inline constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 34;

/// A regular file, of no more bytes; it is not read to find out. Throws Error(input).
std::string read_file(const std::filesystem::path& file, std::uintmax_t most = most_bytes,
                      std::string_view if_too_large = "check that this is the file you mean");
/// Written to a temporary name beside it, then renamed: never half a file. Makes missing folders. Throws Error(output).
void write_file(const std::filesystem::path& file, std::string_view bytes);

} // namespace foam
