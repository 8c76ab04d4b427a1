// Elements that are enlarged for points: what they grow by, in closed form.
#include "geometry/src/convex/polytope.hpp"
#include "geometry/src/convex/kind.hpp"
#include "plain_shapes.hpp"

#include <foam/geometry/measure.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace foam;
using Kind = Element::Kind;

namespace {

constexpr double last_digits = 1e-13;

/// An element and points that are given in its frame, somewhere.
struct Placed {
    Element element;
    std::vector<Vec3> points;
};

Placed placed(Element e, const std::vector<Vec3>& own, Random& random) {
    e.pose = test::random_pose(random, 2);
    Placed result{e, {}};
    for (const Vec3& p : own) {
        result.points.push_back(e.pose * p);
    }
    return result;
}

/// Where the middle of an element is in the frame of another.
Vec3 shift(const Element& from, const Element& to) {
    return from.pose.inverse() * to.pose.translation;
}

/// Expects that an element's core reaches from `low` to `high` in the frame of the element that it was.
void expect_core(const Element& before, const Element& after, const Vec3& low, const Vec3& high) {
    EXPECT_EQ(after.pose.rotation, before.pose.rotation);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(shift(before, after)[axis] - after.half[axis], low[axis], last_digits) << axis;
        EXPECT_NEAR(shift(before, after)[axis] + after.half[axis], high[axis], last_digits) << axis;
    }
}

TEST(ElementEnlarged, ABoxReachesEachPointAlongEachAxis) {
    Random random(1);
    for (const double room : {0.0, 0.25}) {
        const Element box{.kind = Kind::box, .half = {1, 2, 3}};
        for (int axis = 0; axis < 3; ++axis) {
            for (const double side : {-1.0, 1.0}) {
                Vec3 p{0.5, 0.5, 0.5}, low = -box.half, high = box.half;
                p[axis] = 4 * side;
                (side < 0 ? low : high)[axis] = (4 + room) * side;
                const auto [element, points] = placed(box, {p, {0.1, -0.2, 0.3}}, random);
                expect_core(element, enlarged(element, points, room), low, high);
            }
        }
        const auto [element, points] = placed(box, {{-4, 5, 0}, {6, 0, -7}, {0, 0, 8}}, random);
        expect_core(element, enlarged(element, points, room), Vec3{-4 - room, -2, -7 - room},
                    Vec3{6 + room, 5 + room, 8 + room});
    }
}

TEST(ElementEnlarged, ACylinderReachesEachPointAcrossAndAlong) {
    Random random(2);
    for (const double room : {0.0, 0.25}) {
        const Element cylinder{.kind = Kind::cylinder, .half = {0, 0, 1}, .radius = 2};
        const auto expect = [&](const std::vector<Vec3>& own, double radius, double low, double high) {
            const auto [element, points] = placed(cylinder, own, random);
            const Element result = enlarged(element, points, room);
            expect_core(element, result, {0, 0, low}, {0, 0, high});
            EXPECT_NEAR(result.radius, radius, last_digits);
        };
        expect({{0.3, 0.4, 0.5}}, 2, -1, 1);
        expect({{3, 4, 0.5}}, 5 + room, -1, 1);
        expect({{0.3, 0.4, 3}}, 2, -1, 3 + room);
        expect({{0.3, 0.4, -3}}, 2, -3 - room, 1);
        expect({{-3, 4, -3}, {1, 0, 4}}, 5 + room, -3 - room, 4 + room);
    }
}

TEST(ElementEnlarged, ASphereReachesTheFarthestPoint) {
    Random random(3);
    for (const double room : {0.0, 0.25}) {
        const auto [sphere, points] = placed({.kind = Kind::sphere, .radius = 2}, {{2, -3, 6}, {0, 3, 4}}, random);
        const Element result = enlarged(sphere, points, room);
        EXPECT_NEAR(result.radius, 7 + room, last_digits);
        expect_core(sphere, result, {}, {});
        EXPECT_EQ(enlarged(sphere, std::span<const Vec3>{}, room), sphere);
    }
}

TEST(ElementEnlarged, ACapsuleBecomesLongerOrThickerWhicheverAddsLess) {
    Random random(4);
    const Element capsule{.kind = Kind::capsule, .half = {0, 0, 4}, .radius = 5};
    const auto expect = [&](const std::vector<Vec3>& own, double radius, double low, double high) {
        const auto [element, points] = placed(capsule, own, random);
        const Element result = enlarged(element, points, 0);
        expect_core(element, result, {0, 0, low}, {0, 0, high});
        EXPECT_NEAR(result.radius, radius, last_digits);
    };
    expect({{1, 2, 3}}, 5, -4, 4);
    expect({{3, 0, 10}}, 5, -4, 6);   // 3, 4, 5
    expect({{0, -4, -10}}, 5, -7, 4); // 4, 3, 5
    expect({{0, -4, -10}, {3, 0, 10}}, 5, -7, 6);
    expect({{6, 0, 0}}, 6, -4, 4);
    expect({{0, 8, 10}}, 10, -4, 4); // 6, 8, 10
    // a point at the side, and one that the capsule then does not have to be longer for
    expect({{6, 0, 0}, {0, 0, 9.5}}, 6, -4, 4);
    // much longer would be more than a little thicker
    expect({{4.999, 0, 4.5}}, std::hypot(4.999, 0.5), -4, 4);
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

TEST(ElementEnlarged, ASweptBoxBecomesLongerWhereThePointIsFarthest) {
    Random random(6);
    const Element swept{.kind = Kind::swept_box, .half = {1, 2, 3}, .radius = 0.5};
    for (int axis = 0; axis < 3; ++axis) {
        for (const int other : {(axis + 1) % 3, (axis + 2) % 3}) {
            for (const double side : {-1.0, 1.0}) {
                Vec3 p{0.1, 0.2, 0.3}, low = -swept.half, high = swept.half;
                p[axis] = side * (swept.half[axis] + 2);
                p[other] = -side * (swept.half[other] + 0.3); // 3, 4, 5
                (side < 0 ? low : high)[axis] = side * (swept.half[axis] + 2 - 0.4);
                const auto [element, points] = placed(swept, {p}, random);
                const Element result = enlarged(element, points, 0);
                EXPECT_NEAR(result.radius, 0.5, last_digits) << axis << other << side;
                expect_core(element, result, low, high);
            }
        }
    }
    // out by the same at all three: along the first axis, and thicker where that is not enough
    const auto [element, points] = placed(swept, {{1.5, 2.5, 3.5}}, random);
    const Element thicker = enlarged(element, points, 0);
    EXPECT_NEAR(thicker.radius, std::sqrt(0.75), last_digits);
    expect_core(element, thicker, -swept.half, swept.half);
}

TEST(ElementEnlarged, OfAxesThatAreOutByTheSameTheFirstBecomesLonger) {
    const Element swept{.kind = Kind::swept_box, .half = {1, 1, 1}, .radius = 0.5};
    const auto with = [&](const Vec3& p) { return enlarged(swept, std::array{p}, 0).half; };
    const double longer = 1 + 0.2; // 0.4 out, of which 0.3 are within the radius: half of the rest... on one side
    EXPECT_GT(with({1.4, 1.4, 0}).x, 1.01);
    EXPECT_EQ(with({1.4, 1.4, 0}).y, 1);
    EXPECT_GT(with({1.4, 0, 1.4}).x, 1.01);
    EXPECT_EQ(with({1.4, 0, 1.4}).z, 1);
    EXPECT_GT(with({0, 1.4, 1.4}).y, 1.01);
    EXPECT_EQ(with({0, 1.4, 1.4}).z, 1);
    EXPECT_LT(with({0, 1.4, 1.4}).y, longer);
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
    for (int k = 0; k < 200; ++k) {
        const auto length = [&] { return random.uniform(0.1, 1); };
        Element box{.kind = Kind::box, .half = {length(), length(), length()}};
        box.pose.translation = {k % 2 ? 0 : random.uniform(-1, 1), random.uniform(-9, 9), random.uniform(-1e3, 1e3)};
        const Vec3 p = box.pose.translation + test::random_direction(random) * 3;
        SCOPED_TRACE(k);
        expect_around(enlarged(box, std::array{p}, 0), box, p);
    }
}

TEST(ElementEnlarged, EndsFarFromASmallOneAreRoundedOutwards) {
    // The middle moves by much more than the element is large: its place is rounded by more than its ends were.
    Random random(14);
    for (int k = 0; k < 500; ++k) {
        Element box{.kind = Kind::box, .half = Vec3{1, 1, 1} * 1e-6};
        box.pose.translation = test::random_direction(random) * 1e-6;
        const Vec3 p = test::random_direction(random) * 3;
        SCOPED_TRACE(k);
        expect_around(enlarged(box, std::array{p}, 0), box, p);
    }
}

Element cube() {
    Element e{.kind = Kind::hull};
    e.hull = convex_hull(test::box({-1, -1, -1}, {1, 1, 1}).vertices);
    return e;
}

TEST(ElementEnlarged, AHullGetsThePointsWhereItsCornersVanishAndElseFacesMove) {
    Random random(8);
    const double room = 1e-12;
    const auto expect = [&](const std::vector<Vec3>& own, double expected) {
        const auto [element, points] = placed(cube(), own, random);
        const Element result = enlarged(element, points, room);
        EXPECT_NEAR(volume(result), expected, 1e-9);
        EXPECT_LE(result.hull->surface.vertices.size(), 8u);
        EXPECT_EQ(result.pose, element.pose);
        for (const Vec3& p : points) {
            EXPECT_TRUE(holds(result, p));
        }
    };
    expect({{0.5, 0.5, 0.5}}, 8);
    expect({{0, 0, 1.5}}, 8 + 4 * 0.5);                 // the face moves
    expect({{0, 0, 1.5}, {0, 0, -2}}, 8 + 4 * 1.5);     // both
    expect({{0.2, 0, 1.5}, {0.3, 0.1, 2}}, 8 + 4);      // by the farther one
    expect({{1.5, 1.5, 1.5}}, 8 + 3 * 4 * 0.5 / 3);     // the corner moves: three pyramids
    expect({{1.5, 1.5, 1.5}, {-3, -3, -3}}, 8 + 2 + 8); // two corners
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

TEST(ElementEnlarged, TheAddedVolumeIsThatOfTheEnlargedElement) {
    Random random(10);
    const std::vector<Element> elements{{.kind = Kind::sphere, .radius = 1},
                                        {.kind = Kind::capsule, .half = {0, 0, 1}, .radius = 1},
                                        {.kind = Kind::cylinder, .half = {0, 0, 1}, .radius = 1},
                                        {.kind = Kind::box, .half = {1, 1, 1}},
                                        {.kind = Kind::swept_box, .half = {1, 1, 1}, .radius = 1}};
    for (const Element& e : elements) {
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

std::vector<Element> one_of_each() {
    std::vector<Element> all{{.kind = Kind::sphere, .radius = 1},
                             {.kind = Kind::capsule, .half = {0, 0, 1}, .radius = 1},
                             {.kind = Kind::cylinder, .half = {0, 0, 1}, .radius = 1},
                             {.kind = Kind::box, .half = {1, 2, 3}},
                             {.kind = Kind::swept_box, .half = {1, 2, 3}, .radius = 1}};
    all.push_back(cube());
    return all;
}

TEST(ElementEnlarged, WhatHoldsThePointsStaysAsItIs) {
    Random random(12);
    for (const Element& e : one_of_each()) {
        if (e.kind != Kind::hull) { // which gets room in any case
            const auto [element, points] = placed(e, {{0.5, 0.2, -0.3}, {-0.1, 0.4, 0.5}}, random);
            EXPECT_EQ(enlarged(element, points, 0.2), element) << to_string(e.kind);
            EXPECT_EQ(enlarged(element, {}, 0.2), element) << to_string(e.kind);
        }
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

TEST(ElementEnlarged, ScalesWithAll) {
    // Powers of two: numbers differ in their exponents alone, so any step that knows a length would do otherwise.
    Random random(13);
    for (int k = 0; k < 20; ++k) {
        for (const Element& e : one_of_each()) {
            const auto [element, points] =
                placed(e, {test::random_direction(random) * 4, test::random_direction(random) * 2}, random);
            const double room = k % 2 * 1e-3;
            const Element once = enlarged(element, points, room);
            for (const double by : {0x1p-12, 0x1p12}) {
                Element other = element;
                other.pose.translation = other.pose.translation * by;
                other.half = other.half * by;
                other.radius *= by;
                std::vector<Vec3> others;
                for (const Vec3& p : points) {
                    others.push_back(p * by);
                }
                if (e.hull) {
                    std::vector<Vec3> corners = e.hull->surface.vertices;
                    for (Vec3& v : corners) {
                        v = v * by;
                    }
                    other.hull = convex_hull(corners);
                }
                const Element result = enlarged(other, others, room * by);
                EXPECT_EQ(result.radius, once.radius * by) << to_string(e.kind);
                EXPECT_EQ(result.half, once.half * by) << to_string(e.kind);
                EXPECT_EQ(result.pose.translation, once.pose.translation * by) << to_string(e.kind);
                const double more = by * by * by, added = added_volume(element, points) * more;
                EXPECT_NEAR(volume(result), volume(once) * more, 1e-12 * volume(once) * more) << to_string(e.kind);
                EXPECT_NEAR(added_volume(other, others), added, 1e-12 * added) << to_string(e.kind);
            }
        }
    }
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
