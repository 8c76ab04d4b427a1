// What is known of a mesh: its edges, where it meets itself, how far a change moved it.
#pragma once

#include <foam/base/cancellation.hpp>
#include <foam/geometry/mesh.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// Side `number` % 3 of triangle `number` / 3: from that corner to the next.
struct Side {
    std::uint32_t low = 0, high = 0; ///< its ends in ascending order: equal for the sides of one edge
    std::uint32_t number = 0;
    bool forward = false; ///< runs from low to high

    std::uint32_t triangle() const { return number / 3; }
    bool same_edge(const Side& other) const { return low == other.low && high == other.high; }
};

/// Returns the sides of the triangles, sorted by edge, then by number. Sides whose ends are one vertex are left out.
/// `use`, unless empty, marks the triangles to include. O(n) as long as few triangles meet at a vertex.
/// Precondition: corners below `vertex_count`.
std::vector<Side> sides_by_edge(std::span<const Triangle> triangles, std::size_t vertex_count,
                                std::span<const char> use = {});

/// Calls visit(sides) with the sides of every edge, a std::span<const Side>. Asks on the way whether to go on.
template <class Visit> void for_each_edge(std::span<const Side> by_edge, Visit visit) {
    CancellationCounter asking(1 << 16);
    for (std::size_t begin = 0; begin < by_edge.size();) {
        asking.check();
        std::size_t end = begin + 1;
        while (end < by_edge.size() && by_edge[end].same_edge(by_edge[begin])) {
            ++end;
        }
        visit(by_edge.subspan(begin, end - begin));
        begin = end;
    }
}

/// Returns the pairs of triangles (smaller index first, ascending) where an edge of one passes through the interior of
/// the other. Touching in a point or an edge, and overlap in a common plane, do not count. Crossings are counted only
/// where orientation tests in double precision are certain of their sign (error bound of Shewchuk: Adaptive Precision
/// Floating-Point Arithmetic, 1997, section 4.3), even if every coordinate is off by a unit in the last place. O(n log
/// n) for surfaces; deterministic on any number of threads. Precondition: finite vertices, indices in range.
std::vector<std::pair<std::uint32_t, std::uint32_t>> self_intersections(const Mesh& mesh);

/// Distances from points of one surface to the other surface, in the unit of the meshes.
struct OneSidedDistance {
    double max = 0, mean = 0;

    bool operator==(const OneSidedDistance&) const = default;
};

/// A filter's output against its input.
struct MeshChange {
    std::size_t triangles_before = 0, triangles_after = 0;
    Topology before, after;           ///< defects; of the welded mesh unless the mesh is sound as it is indexed
    OneSidedDistance input_to_output; ///< how far the input extends beyond, or lies off, the output
    OneSidedDistance output_to_input; ///< what the output added
    std::optional<double> volume_before, volume_after; ///< m³, signed; absent unless closed and oriented

    /// Returns the two-sided (Hausdorff) distance, sampled.
    double distance() const {
        return input_to_output.max > output_to_input.max ? input_to_output.max : output_to_input.max;
    }
    /// Returns (after - before) / |before|; absent if one of the volumes is.
    std::optional<double> volume_change() const;
};

/// Compares the two meshes. The distances are sampled in both directions, as in Cignoni, Rocchini, Scopigno: Metro,
/// 1998: `points` points uniform by area and as many vertices, so a maximum is approached from below. Equal meshes are
/// not sampled. Deterministic for a seed. O((n + points) log n).
/// Precondition: finite vertices, indices in range, a triangle in each.
MeshChange mesh_change(const Mesh& before, const Mesh& after, std::uint64_t seed, std::size_t points = 500);

/// Proves that every point of `surface` is at most `distance` away from `other`. A piece of a triangle passes if all
/// its corners are that near to one triangle of `other`, since the points near a triangle are a convex set. Other
/// pieces are split and tested again. False as soon as a farther point is found, or after 40 splits of a piece.
/// Preconditions as for mesh_change().
bool lies_within(double distance, const Mesh& surface, const Mesh& other);

/// Returns one line for people: "1204 → 240 triangles, distance 0.31 mm, volume -0.4 %".
std::string describe(const MeshChange& change);

} // namespace geometry
} // namespace foam
