// T-junctions: vertices on an edge of another triangle.
#pragma once

#include <foam/geometry/mesh.hpp>

#include <cstddef>

namespace foam::repair {

/// Splits triangles at open edges where vertices of other open edges lie on them, within `tolerance`. Returns the
/// number of splits. O(b log b) in the open edges as long as few of them overlap along x.
std::size_t join_t_junctions(Mesh& mesh, double tolerance);

} // namespace foam::repair
