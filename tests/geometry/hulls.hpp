// Hulls to grow, and the room that they are to have.
#pragma once

#include "geometry/plain_shapes.hpp"

#include <foam/geometry/element.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace foam::test {

inline std::shared_ptr<const Polytope> hull_of(const std::vector<Vec3>& points) {
    return convex_hull(points);
}

inline std::shared_ptr<const Polytope> random_hull(int corners, Random& random, const Vec3& middle = {}) {
    std::vector<Vec3> points;
    for (int k = 0; k < corners; ++k) {
        points.push_back(middle + random_direction(random));
    }
    return convex_hull(points);
}

/// Expects that all planes of the outer polytope are at least `length` away from the points.
inline void expect_room(const Polytope& outer, std::span<const Vec3> points, double length) {
    for (const Polytope::Face& face : outer.faces) {
        for (const Vec3& p : points) {
            EXPECT_GE(face.offset - dot(face.normal, p), length);
        }
    }
}

/// Two pyramids upon a regular polygon: flat ones have a sharp edge all around.
inline std::vector<Vec3> lens(int corners, double height) {
    std::vector<Vec3> points{{0, 0, height}, {0, 0, -height}};
    for (int k = 0; k < corners; ++k) {
        const double angle = 2 * std::numbers::pi * k / corners;
        points.push_back({std::cos(angle), std::sin(angle), 0});
    }
    return points;
}

/// Returns the hull grown as an element.
inline std::shared_ptr<const Polytope> grown_hull(std::shared_ptr<const Polytope> hull, double length) {
    Element element{.kind = Element::Kind::hull};
    element.hull = std::move(hull);
    return grown(element, length).hull;
}

} // namespace foam::test
