// The part of a surface that given spheres leave uncovered.
#pragma once

#include <foam/geometry/mesh.hpp>
#include <foam/geometry/sphere.hpp>

#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// Returns pieces of the triangles of `surface`. Every point of the surface lies in a piece, or at least 10⁻⁹ of the
/// surface's size inside the spheres. Pieces that cross the boundary of the spheres have edges of at most 1/500 of the
/// surface's size. No triangle is left if the spheres are proved to cover the surface. Precondition: check_corners().
Mesh left_uncovered(const Mesh& surface, const std::vector<Sphere>& spheres);

} // namespace geometry
} // namespace foam
