// The surface in small triangles.
#pragma once

#include "cover/points.hpp"

#include <foam/mesh.hpp>

#include <array>
#include <cstdint>

namespace foam::cover {

/// Triangles in the unit frame, those with long edges halved until they are small beside the balls: then a ball holds a
/// triangle, but for few, if it holds its corners' neighbours. Corners at one place are one point.
struct FineSkin {
    Points points;
    std::vector<std::array<std::uint32_t, 3>> faces;
    double area = 0;  ///< units²
    bool fine = true; ///< false: needles are left with edges longer than that

    /// `pieces`: at least about so many faces.
    FineSkin(const Mesh& surface, const Frame& frame, std::size_t pieces);

    /// About `count` of the points, evenly spread: the first one in each cell of a lattice.
    Points sample(std::size_t count) const;

private:
    void add_faces(const Mesh& surface, const Frame& frame);
    /// Halves edges that are longer; false once that takes more faces than `most_faces`.
    bool halve_long_edges(double longest, std::size_t most_faces);
};

} // namespace foam::cover
