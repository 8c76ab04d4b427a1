// Elements that are enlarged for points, somewhere, and where their cores then reach.
#pragma once

#include "geometry/plain_shapes.hpp"

#include <foam/geometry/element.hpp>

#include <gtest/gtest.h>

#include <vector>

namespace foam::test {

/// An element and points that are given in its frame, somewhere.
struct Placed {
    Element element;
    std::vector<Vec3> points;
};

inline Placed placed(Element e, const std::vector<Vec3>& own, Random& random) {
    e.pose = random_pose(random, 2);
    Placed result{e, {}};
    for (const Vec3& p : own) {
        result.points.push_back(e.pose * p);
    }
    return result;
}

/// Where the middle of an element is in the frame of another.
inline Vec3 shift(const Element& from, const Element& to) {
    return from.pose.inverse() * to.pose.translation;
}

/// Expects that an element's core reaches from `low` to `high` in the frame of the element that it was.
inline void expect_core(const Element& before, const Element& after, const Vec3& low, const Vec3& high,
                        double accuracy) {
    EXPECT_EQ(after.pose.rotation, before.pose.rotation);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(shift(before, after)[axis] - after.half[axis], low[axis], accuracy) << axis;
        EXPECT_NEAR(shift(before, after)[axis] + after.half[axis], high[axis], accuracy) << axis;
    }
}

/// A hull from -1 to 1 along each axis.
inline Element cube() {
    return {.kind = Element::Kind::hull, .hull = convex_hull(box({-1, -1, -1}, {1, 1, 1}).vertices)};
}

} // namespace foam::test
