// A hull with fewer vertices that holds all points.
#pragma once

#include <foam/geometry/element.hpp>
#include <foam/geometry/internal/quickhull.hpp>
#include <foam/geometry/vector.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <queue>
#include <span>
#include <tuple>
#include <vector>

namespace foam::inline search::convex {

/// The points x with dot(normal, x) >= offset, and how much the distance from its plane costs.
struct HalfSpace {
    Vec3 normal; ///< of length 1
    double offset;
    double weight; ///< at least 0
};

/// Returns the point in all half-spaces, to 1e-10, for which the sum of weight · distance from the plane is least.
/// Nothing if there is none with coordinates up to `reach`, or none that is well determined. The dual simplex method
/// (Lemke 1954): a handful of steps, each O(n).
std::optional<Vec3> least_beyond(std::span<const HalfSpace> planes, double reach);

/// A hull of the size 1 that loses vertices and always contains what it contained: progressive hulls (Sander, Gu,
/// Gortler, Hoppe, Snyder: Silhouette clipping, 2000), kept convex. An edge is replaced by the point beyond the planes
/// of all triangles at its ends for which the added volume is least. Triangles that the point is above go as well.
class CollapsingHull {
public:
    /// `triangles`: the hull of the points.
    CollapsingHull(std::span<const Vec3> points, std::span<const geometry::HullTriangle> triangles);

    /// Collapses edges, always the one that adds least volume, until there are at most `most` vertices. Returns false
    /// if no other edge can be collapsed. O(n log n) for n vertices of few triangles each.
    bool reduce_to(std::size_t most);

    std::vector<Vec3> vertices() const;

private:
    static constexpr std::uint32_t none = 0xFFFFFFFFu;

    struct Face {
        std::array<std::uint32_t, 3> corners{}; ///< counter-clockwise seen from outside
        std::array<std::uint32_t, 3> across{};  ///< across[k]: the face beyond the edge from corner k to the next
        Vec3 normal{};
        double offset = 0, area = 0;
        bool alive = true;
        std::uint64_t seen = 0; ///< the last look that found it visible
    };
    struct Collapse {
        double added; ///< volume
        std::uint32_t a, b;
        std::uint64_t version; ///< of its ends when it was looked at
        Vec3 to;

        bool operator>(const Collapse& o) const { return std::tie(added, a, b) > std::tie(o.added, o.a, o.b); }
    };
    struct HorizonEdge {
        std::uint32_t from, to, beyond;
    };

    std::uint64_t version_of(std::uint32_t a, std::uint32_t b) const { return versions_[a] + versions_[b]; }
    bool is_vertex(std::uint32_t v) const { return face_at_[v] != none; }
    /// Returns the index of a corner of a face.
    std::size_t index_in(std::uint32_t face, std::uint32_t v) const;
    std::uint32_t add_face(std::uint32_t a, std::uint32_t b, std::uint32_t c);
    void offer_all();
    void offer(std::uint32_t a, std::uint32_t b);
    /// Begins a look with the faces at both ends of an edge as visible. Returns false if it is no longer an edge.
    bool look_from(std::uint32_t a, std::uint32_t b);
    /// Adds the faces that the point is above, and returns the volume between all visible ones and the point.
    double look_at(const Vec3& p);
    /// Finds the edges around the visible faces. Returns false if they are not one ring without narrow corners.
    bool find_horizon(const Vec3& p);
    void replace_visible(const Vec3& p);
    bool collapse(const Collapse& collapse);

    std::vector<Vec3> points_;
    std::vector<Face> faces_;
    std::vector<std::uint32_t> face_at_;  ///< of each point, one of its faces; none: it is no vertex
    std::vector<std::uint64_t> versions_; ///< of each point: how often its faces changed
    std::vector<std::uint32_t> begin_;    ///< of each point, the edge of the horizon that begins there
    std::size_t count_ = 0;               ///< of vertices
    std::priority_queue<Collapse, std::vector<Collapse>, std::greater<>> queue_;
    std::vector<std::uint32_t> visible_, free_;
    std::vector<HorizonEdge> horizon_;
    std::uint64_t look_ = 0;
};

/// Returns a polytope with at most `most` vertices (at least 4) that contains the given one, to about 1e-9 of its
/// size: by CollapsingHull. A box around it, or a tetrahedron, where that cannot reach the number.
std::shared_ptr<const Polytope> with_fewer_vertices(const Polytope& polytope, std::size_t most);

} // namespace foam::inline search::convex
