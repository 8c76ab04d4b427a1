// The distance of two convex elements, against what is known of them.
#include <foam/base/random.hpp>
#include <foam/collision/separation.hpp>
#include <foam/geometry/vector.hpp>

#include <gtest/gtest.h>

#include <numbers>

namespace foam {
namespace {

Element ball(const Vec3& center, double radius) {
    return element_of({center, radius});
}

Element box(const Vec3& center, const Vec3& half) {
    Element element;
    element.kind = Element::Kind::box;
    element.pose.translation = center;
    element.half = half;
    return element;
}

/// An element of any kind, of a size of about 1, turned and placed by chance.
Element any(Random& random, Element::Kind kind) {
    Element element;
    element.kind = kind;
    const auto number = [&](double low, double high) { return random.uniform(low, high); };
    element.pose = Pose::from_xyz_rpy({number(-0.8, 0.8), number(-0.8, 0.8), number(-0.8, 0.8)},
                                      {number(-3, 3), number(-3, 3), number(-3, 3)});
    if (kind == Element::Kind::hull) {
        std::vector<Vec3> corners;
        for (int i = 0; i < 20; ++i) {
            corners.push_back({number(-0.6, 0.6), number(-0.4, 0.4), number(-0.8, 0.8)});
        }
        element.hull = convex_hull(corners);
        return element;
    }
    const bool long_kind = kind == Element::Kind::capsule || kind == Element::Kind::cylinder;
    const bool edges =
        kind == Element::Kind::box || kind == Element::Kind::swept_box || kind == Element::Kind::ellipsoid;
    element.half = edges ? Vec3{number(0.1, 0.6), number(0.1, 0.6), number(0.1, 0.6)}
                         : Vec3{0, 0, long_kind ? number(0.1, 0.8) : 0};
    element.radius = kind == Element::Kind::box || kind == Element::Kind::ellipsoid ? 0 : number(0.1, 0.4);
    return element;
}

Element shifted(Element element, const Vec3& by) {
    element.pose.translation += by;
    return element;
}

TEST(Separation, OfSpheresIsExact) {
    EXPECT_NEAR(separation(ball({}, 1), ball({3, 0, 0}, 0.5)).low, 1.5, 1e-9);
    EXPECT_EQ(separation(ball({}, 1), ball({3, 0, 0}, 0.5)).depth, 0);
    EXPECT_NEAR(separation(ball({}, 1), ball({0, 1.2, 0}, 0.5)).depth, 0.3, 1e-9);
    EXPECT_EQ(separation(ball({}, 1), ball({0, 1.2, 0}, 0.5)).low, 0);
    EXPECT_NEAR(separation(ball({}, 1), ball({}, 0.5)).depth, 1.5, 1e-9);
}

TEST(Separation, OfBoxesIsTheirGap) {
    const Element a = box({}, {1, 1, 1});
    EXPECT_NEAR(separation(a, box({3, 0.2, -0.3}, {1, 1, 1})).low, 1, 1e-6) << "face to face";
    EXPECT_NEAR(separation(a, box({3, 3, 0}, {1, 1, 1})).low, std::numbers::sqrt2, 2e-6) << "edge to edge";
    EXPECT_NEAR(separation(a, box({3, 3, 3}, {1, 1, 1})).low, std::numbers::sqrt3, 2e-6) << "corner to corner";
    EXPECT_NEAR(separation(a, a).depth, 2, 1e-9);
    EXPECT_EQ(separation(a, box({1.9, 0, 0}, {1, 1, 1})).low, 0);
    EXPECT_GT(separation(a, box({1.5, 0, 0}, {1, 1, 1})).depth, 0.4);
}

TEST(Separation, OfBoxesThatAreExactlyOneApartIsAsAccurate) {
    Random random(11);
    for (int round = 0; round < 400; ++round) {
        const auto size = [&] { return static_cast<double>(1 + random.below(40)) / 8; };
        const Vec3 half{size(), size(), size()}, other{size(), size(), size()};
        Vec3 at{size() - 3, size() - 3, size() - 3};
        for (int axis = 0; axis < 3; ++axis) {
            at[axis] = axis == round % 3 ? half[axis] + other[axis] + 1 : std::clamp(at[axis], -half[axis], half[axis]);
        }
        const double low = separation(box({}, half), box(at, other)).low;
        EXPECT_LE(low, 1);
        EXPECT_GE(low, 1 - 2e-6);
    }
}

TEST(Separation, TakesThePosesOfLinks) {
    const Pose away = Pose::from_xyz_rpy({0, 0, 5}, {std::numbers::pi / 2, 0, 0});
    EXPECT_NEAR(separation(box({}, {1, 1, 2}), box({}, {1, 2, 1}), {}, away).low, 5 - 2 - 2, 1e-5);
}

TEST(Separation, FromABallIsThatOfItsMiddle) {
    Random random(3);
    for (int round = 0; round < 300; ++round) {
        const auto kind = static_cast<Element::Kind>(round % element_kinds);
        const Element a = any(random, kind);
        const double radius = random.uniform(0.01, 0.5);
        const Vec3 middle{random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)};
        const double exact = distance(a, middle) - radius;
        const bool is_exact = kind != Element::Kind::hull;
        for (const Separation& between : {separation(a, ball(middle, radius)), separation(ball(middle, radius), a)}) {
            if (is_exact) {
                EXPECT_NEAR(between.low, std::max(exact, 0.0), 3e-6) << to_string(kind);
                EXPECT_LE(between.low, std::max(exact, 0.0)) << "never more";
            }
            if (exact > 0.01) {
                EXPECT_EQ(between.depth, 0);
            } else if (exact < -0.01) {
                EXPECT_EQ(between.low, 0);
                EXPECT_GT(between.depth, distance(a, middle) > 0 && is_exact ? -exact * (1 - 1e-5) - 1e-5 : 0.5 * radius);
            }
        }
    }
}

TEST(Separation, DepthIsWhatHasToBeMovedAtLeast) {
    // Of boxes along the axes: the least overlap. Of round ones: from what their cores leave.
    Random random(4);
    for (int round = 0; round < 200; ++round) {
        const Vec3 half{random.uniform(0.3, 1), random.uniform(0.3, 1), random.uniform(0.3, 1)};
        const Vec3 at{random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)};
        const Vec3 other{random.uniform(0.3, 1), random.uniform(0.3, 1), random.uniform(0.3, 1)};
        double overlap = std::numeric_limits<double>::infinity();
        for (int axis = 0; axis < 3; ++axis) {
            overlap = std::min(overlap, half[axis] + other[axis] - std::abs(at[axis]));
        }
        const double depth = separation(box({}, half), box(at, other)).depth;
        EXPECT_LE(depth, overlap);
        EXPECT_GE(depth, 0.6 * overlap) << "the search is a rough one";
    }
    Element capsule{.kind = Element::Kind::capsule, .half = {0, 0, 1}, .radius = 0.3};
    EXPECT_NEAR(separation(capsule, shifted(capsule, {0.5, 0, 0})).depth, 0.1, 1e-6);
    EXPECT_NEAR(separation(capsule, shifted(capsule, {0, 0.7, 2.5})).low, std::hypot(0.7, 0.5) - 0.6, 1e-6);
    EXPECT_NEAR(separation(capsule, ball({0.4, 0, -0.9}, 0.2)).depth, 0.1, 1e-6);
}

TEST(Separation, WhatMeetsAtItsEndsIsAsDeepThere) {
    // Two long boxes with a corner in common, which is far from the middle of each and from the origin.
    Random random(12);
    for (int round = 0; round < 20; ++round) {
        const Pose pose =
            Pose::from_xyz_rpy({random.uniform(20, 30), 20, 20}, {random.uniform(-3, 3), random.uniform(-1, 1), 1});
        const double depth = separation(box({5, 0.5, 0}, {5, 0.5, 1}), box({0.5, 5, 0}, {0.5, 5, 1}), pose, pose).depth;
        EXPECT_LE(depth, 1);
        EXPECT_GT(depth, 0.5) << round;
    }
}

TEST(Separation, IsConservativeForAllKinds) {
    Random random(7);
    int apart = 0, touching = 0;
    for (int round = 0; round < 600; ++round) {
        const auto first = static_cast<Element::Kind>(round % element_kinds);
        const auto second = static_cast<Element::Kind>(round / element_kinds % element_kinds);
        const Element a = any(random, first), b = any(random, second);
        const Separation between = separation(a, b), other = separation(b, a);
        ASSERT_TRUE(between.low == 0 || between.depth == 0);
        ASSERT_NEAR(between.low, other.low, 1e-5);
        if (between.low > 0) {
            ++apart;
            double nearest = std::numeric_limits<double>::infinity();
            for (const Vec3& direction : fibonacci_directions(500)) {
                nearest = std::min(nearest, distance(a, support(b, direction)));
            }
            // The distance to a hull is from below.
            const bool exact = first != Element::Kind::hull;
            ASSERT_TRUE(!exact || nearest >= between.low * (1 - 1e-9)) << round << " " << nearest << " " << between.low;
            // Closer by a little more than the distance, along any line, is not enough to be apart by more.
            for (const Vec3& direction : fibonacci_directions(20)) {
                const Separation nearer = separation(a, shifted(b, direction * (0.5 * between.low)));
                ASSERT_GE(nearer.low, 0.5 * between.low - 1e-5);
                ASSERT_LE(nearer.low, 1.5 * between.low + 1e-5);
            }
        } else {
            ++touching;
            for (const Vec3& direction : fibonacci_directions(20)) {
                ASSERT_EQ(separation(a, shifted(b, direction * (0.99 * between.depth))).low, 0);
            }
        }
    }
    EXPECT_GT(apart, 100);
    EXPECT_GT(touching, 100);
}

TEST(Separation, ABallInsideIsAsDeepAsItsMiddle) {
    Random random(8);
    int exact_cylinders = 0;
    for (int round = 0; round < 200; ++round) {
        const Vec3 half{random.uniform(0.3, 1), random.uniform(0.3, 1), random.uniform(0.3, 1)};
        const Vec3 at{half.x * random.uniform(-0.6, 0.6), half.y * random.uniform(-0.6, 0.6), half.z * random.uniform(-1, 1)};
        const double radius = random.uniform(0.1, 0.4);
        const Vec3 room{half.x - std::abs(at.x), half.y - std::abs(at.y), half.z - std::abs(at.z)};
        const double in_box = std::min({room.x, room.y, room.z});
        const double in_cylinder = std::min(1 - std::hypot(at.x, at.y), room.z);
        std::vector<Vec3> corners;
        for (int k = 0; k < 8; ++k) {
            corners.push_back({k & 1 ? half.x : -half.x, k & 2 ? half.y : -half.y, k & 4 ? half.z : -half.z});
        }
        Element hull{.kind = Element::Kind::hull};
        hull.hull = convex_hull(corners);
        const Element swept{.kind = Element::Kind::swept_box, .half = half, .radius = 0.2};
        const Element cylinder{.kind = Element::Kind::cylinder, .half = {0, 0, half.z}, .radius = 1};
        const Pose pose = Pose::from_xyz_rpy({random.uniform(-3, 3), 1, 2}, {random.uniform(-3, 3), random.uniform(-1, 1), 1});
        for (const auto& [element, depth] : {std::pair(box({}, half), in_box), std::pair(hull, in_box),
                                             std::pair(swept, in_box + 0.2)}) {
            EXPECT_NEAR(separation(element, ball(at, radius), pose, pose).depth, depth + radius, 1e-9) << to_string(element.kind);
            EXPECT_NEAR(separation(ball(at, radius), element, pose, pose).depth, depth + radius, 1e-9) << to_string(element.kind);
        }
        // The search for a common point may end just beside a round side: no more than that is then known.
        const double found = separation(cylinder, ball(at, radius), pose, pose).depth;
        EXPECT_LE(found, in_cylinder + radius);
        EXPECT_GE(found, radius - 1e-6);
        exact_cylinders += found > in_cylinder + radius - 1e-9 ? 1 : 0;
    }
    EXPECT_GT(exact_cylinders, 100);
}

TEST(Separation, AFlatCoreIsAsDeepAsItsRadius) {
    // Points of a plate are beside it by rounding, and well within its edges. The search for a common point may end beside
    // it, too: no more than its radius is then known.
    Random random(9);
    std::array<int, 3> exact{};
    for (std::size_t round = 0; round < 300; ++round) {
        const int flat = static_cast<int>(round % 3);
        Element plate{.kind = Element::Kind::swept_box, .half = {0.6, 0.6, 0.6}, .radius = 0.2};
        plate.half[flat] = 0;
        Vec3 along{0.2, 0.2, 0.2};
        along[flat] = 0;
        const Pose pose = Pose::from_xyz_rpy({random.uniform(-1, 1), random.uniform(-1, 1), 0.3},
                                             {random.uniform(-3, 3), random.uniform(-1, 1), random.uniform(-3, 3)});
        const double depth = separation(plate, box(along, {0.3, 0.3, 0.3}), pose, pose).depth;
        EXPECT_LE(depth, 0.5);
        EXPECT_GE(depth, 0.2 - 1e-9);
        exact[round % 3] += depth > 0.5 - 1e-9 ? 1 : 0;
    }
    for (const int count : exact) {
        EXPECT_GE(count, 20);
    }
}

TEST(Separation, LeavesRoomForRounding) {
    // A millionth of a millionth of the sizes and the distance, off the gap and off the depth.
    const auto expect_room = [](double taken, double sizes) {
        EXPECT_GT(taken, 0.9e-12 * sizes);
        EXPECT_LT(taken, 1.1e-12 * sizes);
    };
    expect_room(7000 - separation(ball({}, 2000), ball({10'000, 0, 0}, 1000)).low, 2000 + 1000 + 10'000);
    expect_room(500 - separation(ball({}, 2000), ball({0, 2500, 0}, 1000)).depth, 2000 + 1000 + 2500);
    expect_room(3000 - separation(ball({}, 2000), ball({}, 1000)).depth, 2000 + 1000);
    expect_room(1000 - separation(box({}, {3000, 4000, 12'000}), ball({5000, 0, 0}, 1000)).low, 13'000 + 1000 + 2000);
    for (int turn = 0; turn < 5; ++turn) { // a pyramid, of which one corner is farthest from the origin
        std::vector<Vec3> corners{{0, 0, 0}, {0, 0, 3000}, {0, 3000, 0}, {-5000, 0, 0}, {0, 3000, 3000}};
        std::rotate(corners.begin(), corners.begin() + turn, corners.end());
        Element hull{.kind = Element::Kind::hull};
        hull.hull = convex_hull(corners);
        expect_room(1000 - separation(hull, ball({3000, 1000, 1000}, 2000)).low, 5000 + 2000 + 3000);
    }
    for (const Separation& meeting : {separation(ball({}, 1), ball({2, 0, 0}, 1)),
                                      separation(box({}, {1, 1, 1}), box({2, 0, 0}, {1, 1, 1}))}) {
        EXPECT_EQ(meeting.low, 0);
        EXPECT_EQ(meeting.depth, 0);
    }
}

TEST(Separation, OfACylinderAlongItsAxis) {
    const Element cylinder{.kind = Element::Kind::cylinder, .half = {0, 0, 1}, .radius = 0.3};
    for (const double side : {1.0, -1.0}) {
        EXPECT_NEAR(separation(cylinder, ball({0, 0, 3 * side}, 0.5)).low, 1.5, 1e-6);
        EXPECT_NEAR(separation(cylinder, ball({0, 2 * side, 0}, 0.5)).low, 1.2, 1e-5);
        EXPECT_NEAR(separation(cylinder, ball({2 * side, 0, 0}, 0.5)).low, 1.2, 1e-5);
    }
}

} // namespace
} // namespace foam
