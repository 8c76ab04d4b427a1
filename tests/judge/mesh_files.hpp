// Triangles of STL, OBJ and COLLADA files.
#pragma once

#include "vector.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace judge {

/// All bytes of a file. Throws std::runtime_error.
std::string bytes_of(const std::filesystem::path& file);
/// Numbers between white space and commas, each to the nearest double. Throws std::runtime_error for anything else.
std::vector<double> numbers_of(const std::string& text);

/// Whether read_triangles() knows the ending.
bool is_mesh(const std::filesystem::path& file);
/// In the order of the file; COLLADA: in metres, placed by the nodes. Throws std::runtime_error for what it cannot
/// read.
std::vector<Corners> read_triangles(const std::filesystem::path& file);

} // namespace judge
