// Sides of triangles without partner.
#pragma once

#include <foam/geometry/mesh.hpp>

#include <vector>

namespace foam::repair {

/// Side `place` of triangle `triangle`, from corner `place` to the next.
struct OpenSide {
    std::uint32_t from, to, triangle, place;
};

/// Returns the sides whose edge has no other triangle, in the order of the triangles. O(n log n).
std::vector<OpenSide> open_sides(const Mesh& mesh);

} // namespace foam::repair
