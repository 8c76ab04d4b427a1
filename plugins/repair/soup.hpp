// Triangles without connections become a mesh: welded, cleaned, turned, closed.
#pragma once

#include <foam/geometry/mesh.hpp>
#include <foam/sdk/context.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace foam::repair {

/// In place of the index of a triangle or vertex that there is not.
inline constexpr std::uint32_t no_index = 0xFFFFFFFFu;

using Corners = std::array<Vec3, 3>;

inline Corners corners(const Mesh& mesh, const Triangle& t) {
    return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}
/// Returns twice the area along the normal.
inline Vec3 area_vector(const Corners& t) {
    return cross(t[1] - t[0], t[2] - t[0]);
}
/// Returns whether the three corners are collinear to rounding.
bool is_degenerate(const Corners& t);
/// Returns the point of the triangle nearest to `p` (Ericson, Real-Time Collision Detection, 2005, 5.1.5).
Vec3 closest_point(const Corners& t, const Vec3& p);
/// Returns whether the closed cube about `center` and the triangle have a common point: separating axes (Akenine-Möller
/// 2001).
bool overlaps_cube(const Corners& t, const Vec3& center, double half_size);
/// Returns whether the segment from `a` to `b` passes through the triangle. Touching counts, lying in its plane does
/// not.
bool crosses(const Corners& t, const Vec3& a, const Vec3& b);
/// Returns the solid angle of the triangle seen from `p`, positive if `p` is behind it (van Oosterom, Strackee 1983).
double solid_angle(const Corners& t, const Vec3& p);

/// Merges vertices within `tolerance` of each other into the first of them, and removes triangles that lose a corner.
/// Linear time as long as few vertices lie within a tolerance of each other.
Mesh welded_within(const Mesh& mesh, double tolerance);

/// For side k of triangle i (from corner k to corner k + 1) at 3 i + k: the neighbouring triangle's side at that edge.
using Neighbours = std::vector<std::uint32_t>;

/// Returns the neighbours. Where more than two triangles meet at an edge, neighbours are those with the inside between
/// them: bodies that touch along an edge are separate. Nothing if a triangle has a vertex twice, or an edge has an odd
/// number of triangles, or more than two that do not alternately face in and out around it.
std::optional<Neighbours> neighbours(const Mesh& mesh);

/// Component numbers of the triangles, in the order of their first triangle.
struct Components {
    std::vector<std::uint32_t> of_triangle;
    std::size_t count = 0;
};
Components components(const Mesh& mesh, const Neighbours& neighbours);

/// Turns triangles so that all of a component agree with its first triangle. Marks components that were turned in part
/// in `mixed`. Returns false if a component is one-sided (a Klein bottle). `neighbours` stays valid.
bool orient(Mesh& mesh, Neighbours& neighbours, const Components& components, std::vector<char>& mixed);

/// Gives every fan of triangles at a vertex its own copy of the vertex. Returns the number of vertices added.
/// Precondition: the mesh is oriented.
std::size_t split_fans(Mesh& mesh, const Neighbours& neighbours);

struct NestingReport {
    std::size_t turned = 0;   ///< components that were turned inside out
    std::size_t cavities = 0; ///< components that face inwards and stay so
    bool hollow = false;      ///< a component has no volume: the mesh does not bound a solid
};

/// Turns closed, oriented components so that together they bound a solid. Outermost components face outwards; the
/// components inside are turned with them. Inner components may face inwards (cavities) only inside of one that faces
/// outwards. Components in `mixed` have no reliable orientation and face outwards.
NestingReport orient_components(Mesh& mesh, const Components& components, const std::vector<char>& mixed);

/// The result of cleaning: indices and coordinates checked, equal vertices welded, triangles without area and repeated
/// triangles dropped. Throws Error(geometry) if the mesh is not usable: no triangle left, coordinates not finite,
/// extents out of range.
struct Cleaned {
    Mesh all;      ///< welded; triangles without area are kept
    Mesh distinct; ///< welded, no triangle without area or repeated; equal to `all` if it has as many triangles
};
Cleaned clean(const Mesh& mesh, Context& context);

/// Returns the mesh as a closed, oriented 2-manifold of positive volume, if turning triangles and splitting vertices is
/// enough. Reports the changes through the context.
std::optional<Mesh> closed_manifold(const Mesh& given, Context& context);

struct FacingReport {
    std::size_t turned = 0; ///< triangles
    std::size_t walls = 0;  ///< removed triangles with the inside on both sides
};

/// Turns patches (triangles connected over edges of two) so that the outside, by generalised winding number, is in
/// front of them. Removes patches with the inside on both sides: walls between touching bodies.
FacingReport face_outwards(Mesh& mesh, Context& context);

/// Side `place` of triangle `triangle`, from corner `place` to the next.
struct OpenSide {
    std::uint32_t from, to, triangle, place;
};

/// Returns the sides whose edge has no other triangle, in the order of the triangles. O(n log n).
std::vector<OpenSide> open_sides(const Mesh& mesh);

/// Fills holes with triangles between their vertices, of least area (Barequet, Sharir: Filling gaps in the boundary of
/// a polyhedron, 1995). A hole is filled if its loop is flat, whatever its size: at a flat opening the winding number
/// is one half exactly on its plane, so nothing is guessed. Other holes are filled if their extent is at most
/// `largest`. Returns the number of holes filled. O(e³) in the edges of a hole; holes of more than 500 edges stay open.
/// Precondition: triangles at an edge face the same way.
std::size_t fill_holes(Mesh& mesh, double largest, Context& context);

/// Splits triangles at open edges where vertices of other open edges lie on them, within `tolerance`. Returns the
/// number of splits. O(b log b) in the open edges as long as few of them overlap along x.
std::size_t join_t_junctions(Mesh& mesh, double tolerance);

struct SoupOptions {
    double seam = 1e-6; ///< vertices this near to each other, or to an edge, are meant to be one: share of the diagonal
    double largest_hole = 0.1; ///< extent of filled holes that are not flat: share of the diagonal
};

/// Returns the mesh in its shape, if it bounds a solid except for facing, repeats, triangles without area and seams.
std::optional<Mesh> sound(const Cleaned& cleaned, const SoupOptions& options, Context& context);

/// Returns the triangles as a closed, oriented 2-manifold of positive volume: seams sewn, T-junctions joined, patches
/// turned outwards by the winding number, walls between bodies removed, holes filled, touching bodies separated.
/// Nothing if that is not enough. Reports the repairs through the context.
std::optional<Mesh> repaired(const Cleaned& cleaned, const SoupOptions& options, Context& context);

} // namespace foam::repair
