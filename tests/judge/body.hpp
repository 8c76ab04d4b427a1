// Convex elements of a written file.
#pragma once

#include "vector.hpp"

#include <vector>

namespace judge {

/// Half the distance of 1 to the next double.
constexpr Real unit_roundoff = 0x1p-53L;

/// Where an element stands in its link: images of its axes, and its place.
struct Placement {
    Point x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, offset;
    bool turned = false;

    Point apply(const Point& p) const { return p.x * x + p.y * y + p.z * z + offset; }
};

/// A sphere, box, swept box and capsule are a box of three half lengths, some of them 0, widened by a radius.
struct Body {
    enum class Kind { ball, rounded_box, cylinder, hull };
    Kind kind = Kind::ball;
    Placement place; ///< of a hull: only the offset, a point within
    Point half;      ///< of a rounded box; z: half the length of a cylinder
    Real radius = 0;
    /// Half-spaces dot(normal, p - place.offset) <= offset, each of which holds the whole hull.
    struct Plane {
        Point normal; ///< of length 1
        Real offset = 0;
    };
    std::vector<Plane> planes; ///< of a hull
    Real reach = 0;            ///< no point is farther from the place
};

Body ball_at(const Point& center, Real radius);
Body rounded_box(const Placement& place, const Point& half, Real radius);
Body cylinder(const Placement& place, Real half_length, Real radius);
/// The convex hull of the points. Throws std::runtime_error if they lie in a plane.
Body hull_of(const std::vector<Point>& points);

/// By how much p lies outside; below 0: how deep it lies inside. Outside of a hull it is a lower bound, the farthest of
/// its planes; where one is farther out than `enough`, that may be the answer.
Real depth(const Body& body, const Point& p, Real enough);

/// What depth() may be off by, by rounding to 64 bits: coordinates, their differences, and sums of three products, each
/// of them within these lengths. 2^-58 is 64 roundings.
inline Real own_rounding(const Body& body, Real length_of_p) {
    return 0x1p-58L * (length_of_p + length(body.place.offset) + body.reach);
}

} // namespace judge
