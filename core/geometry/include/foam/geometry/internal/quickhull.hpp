// The convex hull of points as triangles.
#pragma once

#include <foam/base/cancellation.hpp>
#include <foam/geometry/vector.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// Largest relative error of one rounding to a double.
inline constexpr double unit_roundoff = 0x1p-53;

/// A triangle of the hull. `across[k]` is the triangle beyond the edge from corner k to the next.
struct HullTriangle {
    std::array<std::uint32_t, 3> corners{}; ///< indices of points, counter-clockwise seen from outside
    std::array<std::uint32_t, 3> across{};
    Vec3 normal{};
    Vec3 at{};        ///< the first corner
    double error = 0; ///< above it, distance() has the right sign; also the most by which a point of the hull exceeds 0
};

/// Returns the distance of a point to the plane, positive outside.
inline double distance(const HullTriangle& t, const Vec3& p) {
    return dot(t.normal, p - t.at);
}

/// The hull of points of the size 1 (coordinates between about 1/2 and 2 at most, or their differences are lost):
/// Barber, Dobkin, Huhdanpaa, "The Quickhull Algorithm for Convex Hulls", 1996. The sides of points are exact where
/// they decide which triangles a point replaces, so the surface is always a closed convex one, in exact arithmetic.
/// Points that are outside of it by less than `tolerance` do not become corners.
class Quickhull {
public:
    /// `size`: more than the distance of any two points.
    Quickhull(std::span<const Vec3> points, double size, double tolerance);

    /// Computes the hull. Returns false if the points lie in a plane, to within the tolerance.
    bool run();

    /// Begins with a tetrahedron, for a caller who may know before the end that the hull is too large. Returns false if
    /// the points lie in a plane.
    bool begin();
    /// Makes one more point a corner, in turn all around: the volume is soon close to that of the whole. Returns false
    /// if none is left that is outside.
    bool grow();
    /// Returns the volume so far: not more than that of the whole hull, but for rounding.
    double volume() const { return six_volumes_ / 6; }

    /// The triangles of the hull that run() made.
    const std::vector<HullTriangle>& triangles() const { return triangles_; }
    /// Points that may be outside of the hull, by no more than the tolerance and rounding.
    const std::vector<std::uint32_t>& near() const { return near_; }

private:
    static constexpr std::uint32_t none = 0xFFFFFFFFu;
    /// What is known of a triangle while the hull is made.
    struct State {
        std::uint32_t first = none; ///< of the points above it, a list by next_
        std::uint32_t farthest = none;
        double height = 0; ///< of the farthest
        double two_areas = 0;
        std::uint64_t seen = 0;
        bool alive = false;
    };

    bool first_tetrahedron(std::array<std::uint32_t, 4>& corners) const;
    std::uint32_t make(std::uint32_t a, std::uint32_t b, std::uint32_t c);
    std::uint32_t place_for_triangle();
    int side(std::uint32_t triangle, const Vec3& p) const;
    bool is_corner(const Vec3& p, std::uint32_t triangle) const;
    void give(std::uint32_t triangle, std::uint32_t point, double height);
    void place(std::uint32_t point, std::span<const std::uint32_t> among);
    void place_beyond(std::uint32_t point, std::uint32_t start);
    void find_visible(std::uint32_t start, const Vec3& apex);
    void replace_visible(std::uint32_t apex);
    bool has_points(std::uint32_t triangle) const { return states_[triangle].alive && states_[triangle].first != none; }
    void add_corner(std::uint32_t triangle);
    void drop_dead();

    std::span<const Vec3> points_;
    double size_, tolerance_;
    std::vector<HullTriangle> triangles_;
    std::vector<State> states_;
    std::vector<std::uint32_t> free_;
    std::vector<std::uint32_t> waiting_; ///< triangles in the order in which they were given their first point
    std::size_t turn_ = 0;               ///< the next of them
    std::vector<std::uint32_t> next_;    ///< of each point, the next in its list
    std::vector<std::uint32_t> begin_;   ///< of each point, the new triangle whose edge on the horizon begins there
    std::vector<std::uint32_t> near_, visible_, made_, open_, looked_at_;
    struct HorizonEdge {
        std::uint32_t from, to, beyond;
    };
    std::vector<HorizonEdge> horizon_;
    std::uint64_t stamp_ = 0;
    double six_volumes_ = 0;
    CancellationCounter asking_{256};
};

/// A tree of boxes around points, for their largest distance from planes. Where most points are far below a plane, a
/// question takes O(log n).
class FarthestPoint {
public:
    /// O(n log n).
    explicit FarthestPoint(std::vector<Vec3> points);

    /// Returns the largest dot(normal, p - at) of the points, and `least` if that is more.
    double above(const Vec3& normal, const Vec3& at, double least) const;

private:
    struct Node {
        Vec3 center{}, half{};           ///< of the box
        std::uint32_t begin, end;        ///< of its points
        std::uint32_t low = 0, high = 0; ///< its parts; 0: none
    };
    std::uint32_t build(std::uint32_t begin, std::uint32_t end);

    std::vector<Vec3> points_;
    std::vector<Node> nodes_;
};

} // namespace gnu::visibility("default")]]geometry

} // namespace foam
