// Triangulated unit spheres.
#pragma once

#include <foam/geometry/mesh.hpp>

namespace foam {

/// Returns the icosahedron with every triangle split into four, `subdivisions` times, all vertices on the unit sphere:
/// 20 · 4^subdivisions triangles.
Mesh icosphere(int subdivisions);

} // namespace foam
