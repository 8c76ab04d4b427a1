// Triangle meshes and what can be said of their topology.
#pragma once

#include <foam/vector.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace foam {

/// Corner indices of a triangle, counter-clockwise seen from outside.
using Triangle = std::array<std::uint32_t, 3>;

/// An indexed triangle mesh. Units and frame are those of whoever hands it over (stages: metres, link frame).
/// Loaders deliver finite vertices and indices in range; nothing else is promised of a raw mesh.
struct Mesh {
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;

    bool operator==(const Mesh&) const = default;
};

/// What filters ask of a mesh: all corners are vertices, and finite; vertices of no triangle may be anything. Throws
/// Error(geometry) naming the first triangle or vertex that is not so.
void check_corners(const Mesh& mesh);

Box bounds(const Mesh& mesh);
/// Sum of the triangles' areas.
double surface_area(const Mesh& mesh);
/// Signed volume by the divergence theorem; the volume of the solid only if the mesh is closed and does not overlap
/// itself.
double signed_volume(const Mesh& mesh);
/// `mesh` with p ↦ pose · (scale ∘ p). A scale with an odd number of negative factors mirrors; the triangles are then
/// flipped, so that the outside stays outside.
Mesh transformed(const Mesh& mesh, const Pose& pose, const Vec3& scale = {1, 1, 1});
/// Both meshes in one, nothing welded.
void append(Mesh& mesh, const Mesh& other);
/// Vertices with identical coordinates become one; triangles that lose a corner that way, and unused vertices, go.
/// O(n log n), deterministic: vertices keep the order of their first use.
Mesh welded(const Mesh& mesh);

/// Defects of a mesh's connectivity, counted on the mesh as it is indexed.
struct Topology {
    std::size_t boundary_edges = 0;       ///< edges of one triangle
    std::size_t nonmanifold_edges = 0;    ///< edges of more than two triangles
    std::size_t nonmanifold_vertices = 0; ///< vertices whose triangles do not form one fan
    std::size_t misoriented_edges = 0;    ///< edges that two triangles pass in the same direction
    std::size_t degenerate_triangles = 0; ///< triangles with a repeated corner or exactly zero area
    std::size_t components = 0;           ///< parts connected over edges

    bool closed() const { return boundary_edges == 0 && nonmanifold_edges == 0; }
    bool manifold() const { return nonmanifold_edges == 0 && nonmanifold_vertices == 0; }
    bool oriented() const { return misoriented_edges == 0; }
    /// Closed, 2-manifold and consistently oriented.
    bool closed_manifold() const { return closed() && manifold() && oriented(); }
};

/// O(n log n).
Topology topology(const Mesh& mesh);
/// One line for people: "12 boundary edges, 3 components"; "closed 2-manifold" if there is nothing to say.
std::string describe(const Topology& topology);

} // namespace foam
