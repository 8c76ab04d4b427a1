// Triangle meshes and their topology.
#pragma once

#include <foam/geometry/vector.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// Corner indices of a triangle, counter-clockwise seen from outside.
using Triangle = std::array<std::uint32_t, 3>;

/// An indexed triangle mesh. Units and frame are those of the caller (stages: metres, link frame). Loaders return
/// finite vertices and indices in range; a raw mesh has no other guaranteed property.
struct Mesh {
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;

    bool operator==(const Mesh&) const = default;
};

/// Checks the precondition of filters: all corners are vertices, and finite. Vertices of no triangle may be anything.
/// Throws Error(geometry) naming the first triangle or vertex that violates it.
void check_corners(const Mesh& mesh);

Box bounds(const Mesh& mesh);
/// Returns the sum of the triangles' areas.
double surface_area(const Mesh& mesh);
/// Returns the signed volume by the divergence theorem. It is the volume of the solid only if the mesh is closed and
/// does not overlap itself.
double signed_volume(const Mesh& mesh);
/// Returns `mesh` with p ↦ pose · (scale ∘ p). A scale with an odd number of negative factors mirrors; the triangles
/// are then flipped, so that the outside stays outside.
Mesh transformed(const Mesh& mesh, const Pose& pose, const Vec3& scale = {1, 1, 1});
/// Appends the other mesh, without welding.
void append(Mesh& mesh, const Mesh& other);
/// Returns the mesh with vertices of identical coordinates merged. It drops triangles that lose a corner that way, and
/// unused vertices. O(n log n), deterministic: vertices keep the order of their first use.
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

/// Counts the defects. O(n log n).
Topology topology(const Mesh& mesh);
/// Returns one line for people: "12 boundary edges, 3 components"; "closed 2-manifold" if there are no defects.
std::string describe(const Topology& topology);

} // namespace geometry
} // namespace foam
