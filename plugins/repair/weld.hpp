// Welding of vertices that are nearly the same.
#pragma once

#include <foam/mesh.hpp>

namespace foam::repair {

/// Vertices within `tolerance` of each other become one (the first of them), triangles that lose a corner go. Linear
/// time as long as few vertices lie within a tolerance of each other.
Mesh welded_within(const Mesh& mesh, double tolerance);

} // namespace foam::repair
