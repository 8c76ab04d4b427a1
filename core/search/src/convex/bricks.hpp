// Convex pieces of space that hold a solid together, and the planes that cut them.
#pragma once

#include "hull_of_points.hpp"

#include <foam/geometry/element.hpp>

#include <cstdint>
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

/// A convex piece of space with the part of the surface in it.
struct Brick {
    std::vector<Vec3> points;                        ///< its vertices
    std::vector<std::array<std::uint32_t, 2>> edges; ///< between these
    Polygons surface;
    Box box;
};

/// Returns the brick around points; without volume it has its points and no edge.
Brick brick_around(HullOfPoints& hull, std::vector<Vec3> points, Polygons surface);
/// Returns the two parts of a brick on both sides of a plane; a part that is empty has no points.
std::array<Brick, 2> cut(HullOfPoints& hull, const Brick& brick, const Plane& plane);

} // namespace foam::inline search::convex
