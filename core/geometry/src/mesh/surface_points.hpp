// Points spread over a mesh.
#pragma once

#include <foam/geometry/solid.hpp>

namespace foam::inline geometry {

/// Returns one point in each of `count` equal shares of the area, in the order of the triangles, placed in its triangle
/// by the map of Osada, Funkhouser, Chazelle, Dobkin 2002, equation 1. Precondition: at least one triangle.
std::vector<SurfacePoint> sampled_surface(const Mesh& mesh, std::size_t count, std::uint64_t seed);

} // namespace foam::geometry
