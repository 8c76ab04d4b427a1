// The surface in small triangles.
#pragma once

#include "cover/measured/points.hpp"

#include <foam/geometry/mesh.hpp>

#include <array>
#include <cstdint>

namespace foam::inline search::cover {

/// Triangles in the unit frame. Long edges are halved until they are small beside the balls: then nearly always a ball
/// contains a triangle if it contains its corners. Corners at one place are one point.
struct FineSurface {
    Points points;
    std::vector<std::array<std::uint32_t, 3>> faces;
    /// For each face, bit k is set if the edge from corner k lies on an edge of the surface. Other edges divide a
    /// triangle of the surface.
    std::vector<std::uint8_t> own_edges;
    /// The points with indices from `middles_begin` to before `middles_end` are middles of halved edges.
    std::size_t middles_begin = 0, middles_end = 0;
    double area = 0;  ///< units²
    bool fine = true; ///< false: needles still have longer edges

    /// `pieces`: the least number of faces, about.
    FineSurface(const Mesh& surface, const Frame& frame, std::size_t pieces);

    /// Returns about `count` of the points, evenly spread: the first one in each cell of a lattice.
    Points sample(std::size_t count) const;

private:
    void add_faces(const Mesh& surface, const Frame& frame);
    /// Halves longer edges. Returns false if that takes more faces than `most_faces`.
    bool halve_long_edges(double longest, std::size_t most_faces);
};

} // namespace foam::inline search::cover
