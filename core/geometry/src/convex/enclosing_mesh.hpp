// Closed, outward meshes around bodies about the origin; round parts are circumscribed.
#pragma once

#include <foam/geometry/mesh.hpp>

namespace foam::inline geometry {

Mesh box_mesh(const Vec3& half);
/// Returns a mesh around a capsule about the z axis, or a ball. `half`: half its length without the caps; `segments`:
/// around the circle, at least 3.
Mesh capsule_mesh(double radius, double half, int segments);
Mesh cylinder_mesh(double radius, double half, int segments);

} // namespace foam::inline geometry
