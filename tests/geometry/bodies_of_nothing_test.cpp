// Elements of which erosion leaves nothing: too thin, too large, too far away, or not valid.
#include "evaluate/element_truth.hpp"
#include "geometry/each_body.hpp"
#include "geometry/src/proof/bodies.hpp"

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::geometry;
using namespace foam::test;
using Kind = Element::Kind;

namespace {

class EachBodyOfNothing : public EachBody {}; // mutate.py links the tests of bodies together
INSTANTIATE_TEST_SUITE_P(Kinds, EachBodyOfNothing, eroded_kinds, name_of_kind);

/// An element of a kind that is `thin` across, and 2 m or more in other directions, if it has them.
Element thin_element(Kind kind, double thin) {
    Element e{.kind = kind};
    e.radius = kind == Kind::box || kind == Kind::hull ? 0 : thin;
    if (kind == Kind::hull) {
        e.hull = convex_hull(test::box({-thin, -2, -2}, {thin, 2, 2}).vertices);
    } else if (kind != Kind::sphere) {
        e.half = {kind == Kind::box ? thin : 0, kind == Kind::box || kind == Kind::swept_box ? 2.0 : 0, 2};
    }
    return e;
}

TEST_P(EachBodyOfNothing, WhatIsThinnerThanTheSlackHoldsNothing) {
    for (const double share : {0.3, 0.98, 1.02, 3.0}) { // of the slack
        const Element e = thin_element(GetParam(), share * 2 * unit * (most_halvings + 24) * 100 * caution);
        const double reach = norm(bounds(e).size()) / 2;
        const Bodies bodies(Elements(std::span(&e, 1)), {}, 100 - reach, most_halvings, caution);
        EXPECT_EQ(bodies.holds(0, Vec3{}), share > 1) << share;
        std::vector<std::uint32_t> found;
        bodies.meeting({{-9, -9, -9}, {9, 9, 9}}, found);
        EXPECT_EQ(found.size(), share > 1 ? 1u : 0u) << share;
        EXPECT_EQ(bodies.depth(0, {}) < 0, share > 1) << share;
        EXPECT_EQ(std::isinf(bodies.growth(0, {50, 0, 0})), share < 1) << share;
    }
}

TEST_P(EachBodyOfNothing, OfWhatIsAsThinAsTheSlackNothingIsLeft) {
    const auto body_of = [](const Element& e) { return Bodies(Elements(std::span(&e, 1)), {}, 30, most_halvings); };
    double about = 1e-12;
    for (int k = 0; k < 3; ++k) {
        about = body_of(thin_element(GetParam(), about)).slack(0);
    }
    const int steps = 400; // of a last digit, among which what is left is 0 exactly
    int none = 0, some = 0;
    double thin = about * (1 - steps / 4 * 0x1p-52);
    for (int k = 0; k < steps; ++k) {
        thin = std::nextafter(thin, 1);
        const Element e = thin_element(GetParam(), thin);
        const Bodies bodies = body_of(e);
        double left = thin - bodies.slack(0);
        for (const Polytope::Face& plane : e.hull ? bodies.planes(0) : std::span<const Polytope::Face>{}) {
            left = std::min(left, plane.offset);
        }
        none += left == 0;
        some += left > 0;
        EXPECT_EQ(bodies.holds(0, bodies.center(0)), left > 0) << left;
        EXPECT_EQ(std::isinf(bodies.depth(0, {})), !(left > 0)) << left;
    }
    EXPECT_GT(none, 0);
    EXPECT_GT(some, 0);
}

TEST(Bodies, WhatARadiusDoesNotSufficeForIsTakenFromTheBox) {
    Element e{.kind = Kind::swept_box, .half = {1, 2, 3}, .radius = 1e-9};
    const double slack = Bodies(Elements(std::span(&e, 1)), {}, 5, most_halvings, caution).slack(0);
    ASSERT_GT(slack, 1e-5);
    for (const double share : {0.1, 0.5, 0.9, 1.1}) {
        e.radius = share * slack;
        const Bodies bodies(Elements(std::span(&e, 1)), {}, 5, most_halvings, caution);
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 p{};
            const double end = e.half[axis] + e.radius - bodies.slack(0);
            for (const double off : {-1e-9, 1e-9}) {
                p[axis] = end + off;
                EXPECT_EQ(bodies.holds(0, p), off < 0) << axis << ' ' << share;
                EXPECT_NEAR(bodies.depth(0, p), off, 1e-12);
            }
        }
        EXPECT_EQ(bodies.planes(0).size(), share < 1 ? 6u : 0u);
    }
}

TEST(Bodies, NothingIsLeftOfABoxThatIsThinAlongAnyAxis) {
    for (int axis = 0; axis < 3; ++axis) {
        for (const double share : {0.5, 0.99, 1.01}) { // of the slack
            Element e{.kind = Kind::box, .half = {2, 2, 2}};
            const double slack = 2 * unit * (most_halvings + 24) * (30 + std::sqrt(8));
            e.half[axis] = share * slack;
            const Bodies bodies(Elements(std::span(&e, 1)), {}, 30, most_halvings);
            EXPECT_NEAR(bodies.slack(0), slack, 1e-6 * slack);
            EXPECT_EQ(bodies.holds(0, Vec3{}), share > 1) << axis << ' ' << share;
            EXPECT_EQ(std::isinf(bodies.depth(0, Vec3{})), share < 1) << axis << ' ' << share;
        }
    }
}

TEST(Bodies, NothingIsLeftOfACylinderThatIsAsShortAsTheSlack) {
    int none = 0;
    for (int k = -200; k < 200; ++k) {
        Element e{.kind = Kind::cylinder, .half = {0, 0, 1e-30}, .radius = 2};
        const double slack = Bodies(Elements(std::span(&e, 1)), {}, 1, most_halvings).slack(0);
        e.half.z = slack * (1 + k * 0x1p-52);
        const Bodies bodies(Elements(std::span(&e, 1)), {}, 1, most_halvings);
        none += e.half.z == bodies.slack(0);
        EXPECT_EQ(bodies.holds(0, Vec3{}), e.half.z > bodies.slack(0)) << k;
    }
    EXPECT_GT(none, 0);
}

TEST_P(EachBodyOfNothing, WhatIsTooLargeOrTooFarHoldsNothing) {
    Element e = some_element(GetParam(), random);
    e.pose = {};
    const auto is_left = [&](const Element& of, const Vec3& origin) {
        return !std::isinf(Bodies(Elements(std::span(&of, 1)), origin, 1, most_halvings).depth(0, {}));
    };
    EXPECT_TRUE(is_left(e, {}));
    EXPECT_FALSE(is_left(e, {1e200, 0, 0})); // the square of the distance overflows
    e.pose.translation = {1.7e308, 0, 0};
    EXPECT_FALSE(is_left(e, {-1.7e308, 0, 0})); // the difference does
    e = some_element(GetParam(), random);
    e.pose = {};
    e.pose.rotation[2].z = -1; // a reflection
    EXPECT_EQ(is_left(e, {}), GetParam() == Kind::sphere);
    if (e.hull) {
        return;
    }
    e = thin_element(GetParam(), 1e-290); // its length squared overflows, its volume does not
    e.half = e.half * 1e159;
    EXPECT_FALSE(is_left(e, {}));
}

} // namespace
