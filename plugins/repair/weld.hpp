// Welding of nearly equal vertices.
#pragma once

#include <foam/geometry/mesh.hpp>

namespace foam::repair {

/// Merges vertices within `tolerance` of each other into the first of them, and removes triangles that lose a corner.
/// Linear time as long as few vertices lie within a tolerance of each other.
Mesh welded_within(const Mesh& mesh, double tolerance);

} // namespace foam::repair
