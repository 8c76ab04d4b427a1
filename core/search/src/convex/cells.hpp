// A body as cells of a grid, the bricks they make, and the cuts between them.
#pragma once

#include "by_spheres/measured/occupancy.hpp"
#include "cloud.hpp"

#include <foam/geometry/element.hpp>
#include <foam/geometry/solid.hpp>

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace foam::inline search::convex {

/// All points with normal · p = offset. The part above it has larger values.
struct Plane {
    Vec3 normal;
    double offset = 0;

    double height(const Vec3& p) const { return dot(normal, p) - offset; }
};

/// Points nearer to a plane than this, in units, lie on it.
constexpr double on_plane = 1e-9;

/// Returns the point of a segment on a plane, from the heights of its ends on both sides.
inline Vec3 crossing(const Vec3& a, const Vec3& b, double height_a, double height_b) {
    return a + (b - a) * (height_a / (height_a - height_b));
}

/// Convex polygons, one after another.
struct Polygons {
    std::vector<Vec3> corners;
    std::vector<std::uint32_t> ends; ///< of each polygon, one past its last corner

    void close() { ends.push_back(static_cast<std::uint32_t>(corners.size())); }
    void append(const Polygons& other);
    /// Returns the sum of the signed volumes of the cones from the origin.
    double cone_volume() const;
};

/// Cuts polygons. `rim`, unless null, gets the edges along the plane of the parts below, as pairs of points.
void cut(const Polygons& whole, const Plane& plane, Polygons& below, Polygons& above, std::vector<Vec3>* rim = nullptr);

/// A convex part of space by its corners and the edges between them.
struct Region {
    std::vector<Vec3> corners;
    std::vector<std::array<std::uint32_t, 2>> edges;
};

/// A convex piece of space with the part of the surface in it.
struct Brick {
    std::vector<Vec3> points;                        ///< its vertices
    std::vector<std::array<std::uint32_t, 2>> edges; ///< between these
    Polygons surface;
    /// What it was cut from, of a body whose inside is to be held. What a brick has of the body is in the hull of its
    /// surface and of those corners that are inside.
    std::vector<Region> regions;
    Box box;
};

/// Returns the brick around points; without volume it has its points and no edge.
Brick brick_around(HullOfPoints& hull, std::vector<Vec3> points, Polygons surface);
/// Returns the convex region of these corners.
Region region_around(HullOfPoints& hull, const std::vector<Vec3>& corners);
/// Returns the regions on both sides of a plane.
std::array<std::vector<Region>, 2> cut(HullOfPoints& hull, std::span<const Region> regions, const Plane& plane);
/// Returns the mean of one or more points.
Vec3 mean_of(std::span<const Vec3> points);
/// Returns the two parts of a brick on both sides of a plane; a part that is empty has no points.
std::array<Brick, 2> cut(HullOfPoints& hull, const Brick& brick, const Plane& plane);

/// A surface in units, and what is known of its inside.
struct Body {
    Polygons surface;
    std::vector<std::uint32_t> vertices;     ///< of each corner of the surface, the number of its vertex
    bool has_inside = false;                 ///< also of an open surface that encloses most of a volume
    bool is_filled = false;                  ///< pieces are to hold what is inside
    bool volumes_by_surface = false;         ///< the surface tells the volumes of the body's parts
    std::function<bool(const Vec3&)> inside; ///< whether a point is within the surface
    std::vector<Vec3> samples;               ///< points evenly spread inside, where the surface tells no volumes
    double sample_volume = 0;                ///< cubic units that each of them stands for
    std::vector<Plane> creases;              ///< planes through concave edges, important ones first
    std::vector<Plane> faces;                ///< planes of large flat parts of the surface, large ones first
};

/// Appends the corners of a convex region that are inside the body, or on its surface with the body before them.
void add_corners_inside(const Body& body, std::span<const Vec3> corners, std::vector<Vec3>& points);

/// Returns bricks that hold the body together, about `most` of them: space is cut by planes, cells with more volume
/// between their part of the body and its hull than a threshold once more, and the threshold is lowered round by round.
/// A cell's plane is the one of those through concave edges and across the cell's axes whose two hulls have least
/// volume together.
std::vector<Brick> bricks_of(const Body& body, std::size_t most);

/// A body and its unit frame: p = origin + unit · q.
struct BodyOfSolid {
    Body body;
    Vec3 origin{};
    double unit = 1; ///< m
};

/// Returns the body of a solid, which must outlive it. O(n log n).
BodyOfSolid body_of(const Solid& solid);

/// Returns bricks that hold the surface together: space is halved across the longest side of the brick with the
/// longest, again and again, until `count` bricks have a part of the surface. Of a body that is filled, bricks inside
/// it come with them. Much quicker than bricks_of(), for elements that are larger than bricks.
std::vector<Brick> halved_bricks(const Body& body, std::size_t count);

/// The price of putting points into one element: its volume in cubic units.
using Price = std::function<double(std::span<const Vec3>)>;
/// The price of putting points into two elements, or into one if the second has none; of `limit` or more, a lower bound
/// that is also `limit` or more.
using PairPrice = std::function<double(std::span<const Vec3>, std::span<const Vec3>, double limit)>;

/// A plane through bricks, with the price of both parts.
struct Cut {
    Plane plane;
    double price = std::numeric_limits<double>::infinity(); ///< infinite: a part is empty
};

/// Appends points in a plane that belong to both parts, besides those where it crosses edges of bricks.
using PointsInPlane = std::function<void(const Plane&, std::vector<Vec3>&)>;

class CutSearch {
public:
    CutSearch(const std::vector<const Brick*>& bricks, const PairPrice& price, PointsInPlane in_plane = {});

    /// Returns the cut by the plane; where its price is `limit` or more, with a bound for it that is, too.
    Cut at(const Plane& plane, double limit = std::numeric_limits<double>::infinity());
    /// Returns the best of the planes across directions spread evenly, at a few offsets each, and of the first few of
    /// `planes` that pass through the bricks.
    Cut start(std::span<const Plane> planes);
    /// Moves and tilts the plane by shorter and shorter steps, as long as that makes the price less; about as many
    /// planes as `tries`.
    Cut improved(Cut best, int tries);

private:
    void set_points(const std::vector<const Brick*>& bricks);
    /// Sets below_ and above_ to the points of the parts of all bricks, each once.
    void divide(const Plane& plane);

    std::vector<Vec3> points_;                        ///< vertices of the bricks, each once
    std::vector<std::array<std::uint32_t, 2>> edges_; ///< between these, each once
    std::vector<std::uint32_t> corners_, ends_;       ///< the vertices of each brick, one brick after another
    std::vector<double> heights_;
    std::vector<char> in_; ///< of each vertex: 1 for a part below, 2 for one above
    Box box_;
    const PairPrice& price_;
    PointsInPlane in_plane_;
    std::vector<Vec3> below_, above_, both_;
};

/// Sums over a lattice of a region, in the unit frame of a body. The surfaces of elements are blurred over the width of
/// a cell, so that sums vary smoothly with the elements.
class OutsideLattice {
public:
    /// The occupancy must outlive this.
    explicit OutsideLattice(const by_spheres::Occupancy& occupancy) : occupancy_(occupancy) {}

    /// Prepares a lattice of about so many cells over a region, beside the others. O(cells · others).
    void look(std::span<const Fit> others, const Box& region, std::size_t cells);
    /// Returns the volume of the union of the elements without the others and the solid, units³. What is beyond the
    /// region counts in full, and with a surcharge. O(cells · elements).
    double of(std::span<const Fit> elements);
    /// Returns the share of a place that is outside the solid.
    double outside_solid(const Vec3& p) const;

private:
    /// Makes the share that is held at each place at least that of the fit.
    void hold(const Fit& fit);

    const by_spheres::Occupancy& occupancy_;
    Box region_;
    double cell_ = 1;
    int longest_ = 0;                       ///< axis of the region: places ascend along it
    std::vector<float> x_, y_, z_, weight_; ///< places not entirely inside others or the solid
    std::vector<float> held_;
};

/// Returns the box around a fit.
Box bounds(const Fit& fit);

} // namespace foam::inline search::convex
