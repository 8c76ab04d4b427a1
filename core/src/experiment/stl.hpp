// A mesh as a file that loaders can be timed on.
#pragma once

#include <foam/mesh.hpp>

#include <string>

namespace foam::experiment {

/// Binary STL, corners rounded to single precision.
std::string to_binary_stl(const Mesh& mesh);

} // namespace foam::experiment
