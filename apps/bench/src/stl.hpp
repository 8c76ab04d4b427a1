// A mesh as a file that loaders can be timed on.
#pragma once

#include <foam/geometry/mesh.hpp>

#include <string>

namespace foam::inline bench::experiment {

/// Binary STL, corners rounded to single precision.
std::string to_binary_stl(const Mesh& mesh);

} // namespace foam::bench::experiment
