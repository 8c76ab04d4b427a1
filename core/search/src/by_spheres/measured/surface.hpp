// The surface of a solid as points and faces that a cover is to hold.
#pragma once

#include "by_spheres/measured/points.hpp"

#include <foam/geometry/mesh.hpp>

#include <array>
#include <cstdint>
#include <utility>

namespace foam::inline search::by_spheres {

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
    /// Points without faces: what a sensor saw. Their area is that of the cells of a lattice in which they lie.
    explicit FineSurface(Points seen);

    /// Returns about `count` of the points, evenly spread: the first one in each cell of a lattice.
    Points sample(std::size_t count) const;

private:
    void add_faces(const Mesh& surface, const Frame& frame);
    /// Halves longer edges. Returns false if that takes more faces than `most_faces`.
    bool halve_long_edges(double longest, std::size_t most_faces);
};

using Line = std::pair<std::uint32_t, std::uint32_t>; ///< indices of its ends

/// Triangles in the unit frame. Corners at one place, and edges between them, have one index, regardless of the mesh.
struct IndexedSurface {
    struct Face {
        std::array<std::uint32_t, 3> corners, edges; ///< edge k goes from corner k to the next one
        Ball bounds;
    };
    Points points;
    std::vector<Line> edges;
    std::vector<Face> faces;
    bool is_coarse = false; ///< balls that cover the surface may not quite cover it

    IndexedSurface(const Mesh& surface, const Frame& frame);
    /// Makes the coarse skin at once if there are more than `most` points.
    IndexedSurface(const Mesh& surface, const Frame& frame, std::size_t most, int resolution);
    /// Returns a coarse skin: of the points in each cell of a lattice, cells of about 1/`resolution` of the longest
    /// extent, one represents all (Rossignac and Borrel 1993). It lies on the surface, but the surface may extend
    /// beyond it between points.
    IndexedSurface coarse(int resolution) const;

private:
    IndexedSurface() = default;
    void add_faces(const Mesh& surface, const Frame& frame);
    void add_edges();
    /// Returns the coarse skin; without faces if it has none.
    IndexedSurface clustered(int resolution) const;
    /// Returns the point at the place of each vertex in use.
    std::vector<std::uint32_t> name_places(const Mesh& surface, const Frame& frame);
};

} // namespace foam::inline search::by_spheres
