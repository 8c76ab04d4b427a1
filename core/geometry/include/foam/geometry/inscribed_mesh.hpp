// Meshes within convex elements.
#pragma once

#include <foam/geometry/element.hpp>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// Returns a closed mesh within the element, to rounding, in the link's frame: the surface of a box or hull, else a
/// polyhedron whose corners lie on the element. `segments`: around a circle, at least 3.
Mesh inscribed_mesh(const Element& element, int segments = 48);

/// Returns a closed mesh within the unit ball: an icosahedron whose triangles were split into four `subdivisions` times,
/// with its corners on the sphere.
Mesh icosphere(int subdivisions);

} // namespace geometry
} // namespace foam
