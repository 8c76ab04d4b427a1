// Elements whose numbers are on no decimal grid.
#pragma once

#include "geometry/plain_shapes.hpp"

#include <foam/geometry/element.hpp>
#include <foam/runtime/internal/cover.hpp>

namespace foam::test {

inline bool is_on(const DecimalGrid& grid, double value) {
    return grid.nearest(value) == value;
}
inline bool is_on(const DecimalGrid& grid, const Vec3& v) {
    return grid.nearest(v) == v;
}

/// An element of a kind whose numbers are on no grid.
inline Element odd(Element::Kind kind, double size) {
    Element e;
    e.kind = kind;
    e.pose = Pose::from_axis_angle(normalized({1, 2, 3}), 0.7);
    e.pose.translation = Vec3{0.1234567891, -0.2345678912, 0.3456789123} * size;
    if (kind == Element::Kind::sphere) {
        e.pose.rotation = Pose{}.rotation;
    }
    if (kind == Element::Kind::hull) {
        Random random(3);
        std::vector<Vec3> points;
        for (int k = 0; k < 12; ++k) {
            points.push_back(random_direction(random) * (size * random.uniform(0.8, 1)));
        }
        e.hull = convex_hull(points);
        return e;
    }
    e.radius = kind == Element::Kind::box || kind == Element::Kind::ellipsoid ? 0 : 0.4444444444 * size;
    if (kind == Element::Kind::box || kind == Element::Kind::swept_box || kind == Element::Kind::ellipsoid) {
        e.half = Vec3{0.5555555555, 0.6666666666, 0.7777777777} * size;
    } else if (kind != Element::Kind::sphere) {
        e.half.z = 0.8888888888 * size;
    }
    return e;
}

} // namespace foam::test
