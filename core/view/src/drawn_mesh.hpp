// Meshes as buffers that a graphics card draws.
#pragma once

#include <foam/view/subject.hpp>

#include <array>

namespace foam::inline view {

/// A corner of drawn triangles: a place on a grid, and a unit normal on an octahedron (Meyer et al. 2010).
struct DrawnVertex {
    std::array<std::uint16_t, 3> place{};
    std::array<std::int8_t, 2> normal{};

    bool operator==(const DrawnVertex&) const = default;
};

/// Neighbouring triangles of one colour.
struct ColourRange {
    std::size_t first = 0, count = 0; ///< corners in DrawnMesh::corners
    std::optional<Colour> colour;     ///< nothing: that of the element
};

struct DrawnMesh {
    Vec3 low;        ///< place (0, 0, 0)
    double step = 0; ///< m, from one place to the next
    std::vector<DrawnVertex> vertices;
    std::vector<std::uint32_t> corners; ///< three for each triangle
    std::vector<ColourRange> ranges;
};

/// Returns the mesh with normals that are smooth where its faces meet at less than about 40°. Triangles without area on
/// the grid of 65536 places a side are left out. O(n) for n triangles.
DrawnMesh drawn(const ViewedMesh& mesh);

/// Returns the mesh with the vertices of each cube of a grid merged to their mean; triangles keep their colours, and
/// those without area are left out (vertex clustering: Rossignac and Borrel, 1993). `cell`: side of a cube, m, above 0.
/// O(n) for n triangles.
ViewedMesh coarsened(const ViewedMesh& mesh, double cell);

/// Returns the cell with which meshes of this area have about `triangles` triangles, or 0 if there is no area; m.
double cell_for(double area, std::size_t triangles);

} // namespace foam::inline view
