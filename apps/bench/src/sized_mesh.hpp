// A mesh in as many triangles as are asked for.
#pragma once

#include <foam/geometry/mesh.hpp>
#include <foam/sdk/registry.hpp>

namespace foam::inline bench::experiment {

/// The same surface in at least `triangles` triangles, one more at most: the longest edge is split at its middle, again
/// and again (Rivara, 1984), with the triangles on both its sides, so that what is closed stays closed. O(n log n),
/// deterministic. Neighbours
/// stay near each other in memory. A mesh that has as many is returned as it is. Precondition: no edge of zero length.
Mesh refined(const Mesh& mesh, std::size_t triangles);

/// refined(), or simplified by simplify.quadric to the count or as near as that comes.
Mesh sized(const Mesh& mesh, std::size_t triangles, const Registry& registry, Context& context);

} // namespace foam::bench::experiment
