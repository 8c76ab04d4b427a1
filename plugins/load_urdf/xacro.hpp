// Robots as xacro files: the program xacro makes a URDF of them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace foam::urdf {

/// Returns the URDF that the program `xacro` makes of a file. `arguments`: NAME:=VALUE, one a line. Throws Error(input)
/// with the program's own message if it fails, and Error(plugin) with the remedy if there is no such program.
std::string expanded_xacro(const std::filesystem::path& file, const std::string& arguments);

/// Returns the files that xacro reads beside the file, as `xacro --deps` prints them, sorted; without those whose path
/// has blanks.
std::vector<std::filesystem::path> included_by_xacro(const std::filesystem::path& file, const std::string& arguments);

} // namespace foam::urdf
