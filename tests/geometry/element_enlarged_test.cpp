// Elements that are enlarged for points: what they grow by, in closed form.
#include "geometry/placed_elements.hpp"
#include "geometry/src/convex/kind.hpp"
#include "geometry/src/convex/polytope.hpp"

#include <foam/geometry/measure.hpp>

#include <gtest/gtest.h>

using namespace foam;
using test::cube, test::expect_core, test::placed, test::shift;
using Kind = Element::Kind;

namespace {

constexpr double last_digits = 1e-13;

TEST(ElementEnlarged, ASphereReachesTheFarthestPoint) {
    Random random(3);
    for (const double room : {0.0, 0.25}) {
        const auto [sphere, points] = placed({.kind = Kind::sphere, .radius = 2}, {{2, -3, 6}, {0, 3, 4}}, random);
        const Element result = enlarged(sphere, points, room);
        EXPECT_NEAR(result.radius, 7 + room, last_digits);
        expect_core(sphere, result, {}, {}, last_digits);
        EXPECT_EQ(enlarged(sphere, std::span<const Vec3>{}, room), sphere);
    }
}

TEST(ElementEnlarged, RoomIsKeptByALongerCapsule) {
    Random random(5);
    const Element capsule{.kind = Kind::capsule, .half = {0, 0, 4}, .radius = 6};
    for (const double side : {-1.0, 1.0}) {
        const auto [element, points] = placed(capsule, {{3, 0, side * 10}}, random);
        const Element result = enlarged(element, points, 1); // 3, 4, 5
        EXPECT_EQ(result.radius, 6);
        EXPECT_TRUE(holds(result, points[0], 1));
        const double end = 2 * result.half.z - 4;
        EXPECT_GE(end, 6);
        EXPECT_LE(end, 7 + last_digits);
        EXPECT_NEAR(shift(element, result).z, side * (result.half.z - 4), last_digits);
    }
}

/// Expects that a box whose axes are those of the link contains another one and a point.
void expect_around(const Element& result, const Element& box, const Vec3& p) {
    for (int axis = 0; axis < 3; ++axis) {
        const long double at = result.pose.translation[axis], half = result.half[axis];
        const long double old = box.pose.translation[axis];
        EXPECT_LE(at - half, std::min<long double>(p[axis], old - box.half[axis]));
        EXPECT_GE(at + half, std::max<long double>(p[axis], old + box.half[axis]));
    }
}

TEST(ElementEnlarged, EndsAreRoundedOutwards) {
    // In the frame of the element all is exact but for the sum of place and shift.
    Random random(7);
    for (int k = 0; k < 700; ++k) {
        const auto length = [&] { return random.uniform(0.1, 1); };
        Element box{.kind = Kind::box, .half = {length(), length(), length()}};
        box.pose.translation = {k % 2 ? 0 : random.uniform(-1, 1), random.uniform(-9, 9), random.uniform(-1e3, 1e3)};
        if (k >= 200) { // the middle moves by much more than the element is large: its place is rounded by more
            box.half = Vec3{1, 1, 1} * 1e-6;
            box.pose.translation = test::random_direction(random) * 1e-6;
        }
        const Vec3 p = box.pose.translation + test::random_direction(random) * 3;
        SCOPED_TRACE(k);
        expect_around(enlarged(box, std::array{p}, 0), box, p);
    }
}

/// The hull with all faces moved to the points, and the hull of it and the points, both with room.
struct Ways {
    std::shared_ptr<const Polytope> moved, with_points;
};

Ways ways(const Polytope& hull, const std::vector<Vec3>& points, double room) {
    std::vector<double> lengths;
    for (const Polytope::Face& face : hull.faces) {
        double length = 0;
        for (const Vec3& p : points) {
            length = std::max(length, dot(face.normal, p) - face.offset);
        }
        lengths.push_back(length + room);
    }
    std::vector<Vec3> all = hull.surface.vertices;
    all.insert(all.end(), points.begin(), points.end());
    return {with_faces_moved(hull, lengths, points, room), with_room(*convex_hull(all), room)};
}

TEST(ElementEnlarged, AHullTakesTheSmallerOfBothWaysThatAddNoCorner) {
    Random random(9);
    int faces = 0, points = 0, more = 0;
    for (int k = 0; k < 400; ++k) {
        std::vector<Vec3> corners;
        for (int i = 0; i < 5 + k % 5; ++i) {
            corners.push_back(test::random_direction(random));
        }
        Element e{.kind = Kind::hull};
        e.hull = convex_hull(corners);
        const std::vector<Vec3> point{corners[0] * random.uniform(1, 1.1) + test::random_direction(random) * 0.05};
        const double room = std::pow(10, random.uniform(-6, 0.5));
        const auto [moved, with_points] = ways(*e.hull, point, room);
        corners.push_back(point[0]);
        const bool added = convex_hull(corners)->surface.vertices.size() > e.hull->surface.vertices.size();
        ASSERT_TRUE(moved);
        const double by_faces = signed_volume(moved->surface), by_point = signed_volume(with_points->surface);
        (added ? more : by_faces < by_point ? faces : points) += 1;
        EXPECT_NEAR(volume(enlarged(e, point, room)), added ? by_faces : std::min(by_faces, by_point), 1e-12);
        EXPECT_TRUE(holds(enlarged(e, point, room), point[0], room * (1 - 1e-9)));
    }
    EXPECT_GT(faces, 5);
    EXPECT_GT(points, 20);
    EXPECT_GT(more, 20);
}

/// But a hull.
std::vector<Element> one_of_each() {
    return {{.kind = Kind::sphere, .radius = 1},
            {.kind = Kind::capsule, .half = {0, 0, 1}, .radius = 1},
            {.kind = Kind::cylinder, .half = {0, 0, 1}, .radius = 1},
            {.kind = Kind::box, .half = {1, 2, 3}},
            {.kind = Kind::swept_box, .half = {1, 2, 3}, .radius = 1}};
}

TEST(ElementEnlarged, TheAddedVolumeIsThatOfTheEnlargedElement) {
    Random random(10);
    for (const Element& e : one_of_each()) {
        const auto [element, points] = placed(e, {{3, 1, 2}, {-4, 0, 1}}, random);
        EXPECT_NEAR(added_volume(element, points), volume(enlarged(element, points, 0)) - volume(element), 1e-12);
        EXPECT_GT(added_volume(element, points), 1);
    }
}

TEST(ElementEnlarged, TheAddedVolumeOfAHullIsThatOfThePyramidsOfThePointThatAddsMost) {
    Random random(11);
    const auto of = [&](const std::vector<Vec3>& own) {
        const auto [element, points] = placed(cube(), own, random);
        return added_volume(element, points);
    };
    EXPECT_EQ(of({{0.1, 0.2, 0.3}}), 0);
    EXPECT_NEAR(of({{0, 0.5, 1.5}}), 4 * 0.5 / 3, 1e-12);
    EXPECT_NEAR(of({{-1.5, 0.5, 0}, {0.1, 0, 0}}), 4 * 0.5 / 3, 1e-12);
    EXPECT_NEAR(of({{0, 0.5, 1.5}, {2, -2, 2}}), 3 * 4 * 1.0 / 3, 1e-12);
    EXPECT_NEAR(of({{0, 2, -3}}), 4 * (1 + 2.0) / 3, 1e-12);
}

TEST(ElementEnlarged, WhatHoldsThePointsStaysAsItIs) {
    Random random(12);
    for (const Element& e : one_of_each()) { // a hull gets room in any case
        const auto [element, points] = placed(e, {{0.5, 0.2, -0.3}, {-0.1, 0.4, 0.5}}, random);
        EXPECT_EQ(enlarged(element, points, 0.2), element) << to_string(e.kind);
        EXPECT_EQ(enlarged(element, {}, 0.2), element) << to_string(e.kind);
    }
    const Element box{.kind = Kind::box, .half = {1, 2, 3}}; // points upon its faces
    EXPECT_EQ(enlarged(box, std::vector<Vec3>{{1, 2, 3}, {-1, -2, -3}}, 0), box);
}

TEST(ElementEnlarged, ACapsuleThatHoldsAPointWithRoomIsNotLongerThere) {
    const Element capsule{.kind = Kind::capsule, .half = {0, 0, 4}, .radius = 6};
    const std::vector<Vec3> points{{0, 0, 9}, {0, 0, -20}}; // the first with all of the room
    const Element result = enlarged(capsule, points, 1);
    EXPECT_EQ(result.radius, 6);
    EXPECT_NEAR(result.pose.translation.z + result.half.z, 4, last_digits);
    EXPECT_NEAR(result.pose.translation.z - result.half.z, -20 + 5 - 1, last_digits);
}

TEST(ElementEnlarged, AHullWhoseFacesCannotMoveIsThatOfThePoints) {
    // Thinner than rounding at one end: no vertex can move beyond both of its sides.
    for (const double thin : {1e-13, 1e-12, 1e-11}) {
        const std::vector<Vec3> wedge{{0, 0, 0},    {0, 1, 0},    {1, 0, 0},   {1, 1, 0},
                                      {0, 0, thin}, {0, 1, thin}, {1, 0, 0.1}, {1, 1, 0.1}};
        Element e{.kind = Kind::hull};
        e.hull = convex_hull(wedge);
        for (const Vec3& p : {Vec3{1.5, 0.5, 0}, Vec3{0.5, 0.5, 0.3}, Vec3{-0.5, 0.5, 0}}) {
            const Element result = enlarged(e, std::array{p}, 1e-6);
            ASSERT_TRUE(result.hull);
            EXPECT_TRUE(is_valid(result));
            EXPECT_TRUE(holds(result, p, 1e-6));
            for (const Vec3& corner : wedge) {
                EXPECT_TRUE(holds(result, corner, 1e-6));
            }
        }
    }
}

} // namespace
