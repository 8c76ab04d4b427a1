// Parts of the proof for elements: what is contained by its lengths, which triangles are open, and the bodies that prove.
#include "geometry/src/proof/element_proof.hpp"
#include "geometry/strewn_elements.hpp"

#include <foam/geometry/measure.hpp>
#include <foam/geometry/internal/proof.hpp>

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::geometry;
using test::strewn;
using Kind = Element::Kind;

namespace {

Element element_with(Kind kind, const Vec3& half, double radius) {
    Element e{.kind = kind, .half = half, .radius = radius};
    e.pose.translation = {1, 2, 3};
    return e;
}

bool contains(const Element& e, const Element& p) {
    Pose pose;
    pose.translation = {1, 2, 3};
    return contains_by_lengths(e, {nullptr, p, pose});
}

/// Expects that the element contains the primitive, and not if any of these lengths is a last bit smaller.
void expect_just(Element e, const Element& p, const std::vector<double Element::*>& radii,
                 const std::vector<int>& halves) {
    EXPECT_TRUE(contains(e, p));
    const auto expect_not = [&](double& length) {
        const double before = length;
        length = std::nextafter(length, 0);
        EXPECT_FALSE(contains(e, p)) << to_string(e.kind);
        length = 2 * before;
        EXPECT_TRUE(contains(e, p)) << to_string(e.kind);
        length = before;
    };
    for (double Element::*radius : radii) {
        expect_not(e.*radius);
    }
    for (const int axis : halves) {
        expect_not(e.half[axis]);
    }
    e.pose.translation.x = std::nextafter(1, 2);
    EXPECT_FALSE(contains(e, p)) << to_string(e.kind);
}

TEST(ContainsByLengths, PrimitivesInElementsWithRoomForThem) {
    const Element ball = Element::sphere(0.3), capsule = Element::capsule(0.3, 1),
        cylinder = Element::cylinder(0.3, 1), box = Element::box({1, 2, 3});
    expect_just(element_with(Kind::sphere, {}, 0.3), ball, {&Element::radius}, {});
    expect_just(element_with(Kind::capsule, {0, 0, 0.1}, 0.3), ball, {&Element::radius}, {});
    expect_just(element_with(Kind::swept_box, {0.1, 0.1, 0.1}, 0.3), ball, {&Element::radius}, {});
    expect_just(element_with(Kind::cylinder, {0, 0, 0.3}, 0.3), ball, {&Element::radius}, {2});
    expect_just(element_with(Kind::box, {0.3, 0.3, 0.3}, 0), ball, {}, {0, 1, 2});
    expect_just(element_with(Kind::swept_box, {0.3, 0.3, 0.3}, 0.1), ball, {}, {0, 1, 2});
    expect_just(element_with(Kind::capsule, {0, 0, 0.5}, 0.3), capsule, {&Element::radius}, {2});
    expect_just(element_with(Kind::swept_box, {0.1, 0.1, 0.5}, 0.3), capsule, {&Element::radius}, {2});
    expect_just(element_with(Kind::cylinder, {0, 0, 0.5}, 0.3), cylinder, {&Element::radius}, {2});
    expect_just(element_with(Kind::capsule, {0, 0, 0.5}, 0.3), cylinder, {&Element::radius}, {2});
    expect_just(element_with(Kind::box, {0.5, 1, 1.5}, 0), box, {}, {0, 1, 2});
    expect_just(element_with(Kind::swept_box, {0.5, 1, 1.5}, 0.1), box, {}, {0, 1, 2});
}

TEST(ContainsByLengths, OthersAreNotCompared) {
    const Element ball = Element::sphere(0.3), capsule = Element::capsule(0.3, 1),
        cylinder = Element::cylinder(0.3, 1), box = Element::box({1, 1, 1});
    Element hull = element_with(Kind::hull, {}, 0);
    hull.hull = convex_hull(test::box({-9, -9, -9}, {9, 9, 9}).vertices);
    for (const Element& p : {ball, capsule, cylinder, box}) {
        EXPECT_FALSE(contains(hull, p));
        EXPECT_FALSE(contains(element_with(Kind::box, {-9, 9, 9}, 0), p));
    }
    hull.hull = convex_hull(test::box({1, 1, 1}, {2, 2, 2}).vertices);
    EXPECT_FALSE(contains(hull, Element::sphere(0))) << "the middle is beside it";
    EXPECT_FALSE(contains(element_with(Kind::box, {9, 9, 9}, 0), capsule));
    EXPECT_FALSE(contains(element_with(Kind::cylinder, {0, 0, 9}, 9), capsule));
    EXPECT_FALSE(contains(element_with(Kind::sphere, {}, 9), capsule));
    EXPECT_FALSE(contains(element_with(Kind::box, {9, 9, 9}, 0), cylinder));
    EXPECT_FALSE(contains(element_with(Kind::sphere, {}, 9), cylinder));
    EXPECT_FALSE(contains(element_with(Kind::swept_box, {9, 9, 9}, 9), cylinder));
    EXPECT_FALSE(contains(element_with(Kind::cylinder, {0, 0, 9}, 9), box));
    EXPECT_FALSE(contains(element_with(Kind::capsule, {0, 0, 9}, 9), box));
    const Element ball_around = element_with(Kind::sphere, {}, 9);
    EXPECT_FALSE(contains_by_lengths(
        ball_around, {std::make_shared<const Mesh>(test::ball({}, 1, 4)), std::nullopt, ball_around.pose}));
}

TEST(OpenTriangles, AreThoseThatNoElementContains) {
    Random random(1);
    for (int k = 0; k < 20; ++k) {
        const auto solid = Solid::make(test::ball({1, 2, 3}, 1, 8));
        const std::vector<Element> elements = strewn(solid->surface(), 12, 0.5, random);
        const Balls pieces(*solid, {}, 120);
        const Bodies bodies({{}, elements}, solid->bounds().center(), pieces.extent(), 120);
        std::vector<std::uint32_t> expected;
        for (std::uint32_t t = 0; t < solid->surface().triangles.size(); ++t) {
            const auto& [a, b, c] = solid->surface().triangles[t];
            const auto& v = solid->surface().vertices;
            if (std::none_of(elements.begin(), elements.end(),
                             [&](const Element& e) { return holds(e, v[a]) && holds(e, v[b]) && holds(e, v[c]); })) {
                expected.push_back(t);
            }
        }
        EXPECT_EQ(OpenTriangles(*solid, {{}, elements}, pieces, bodies).triangles(), expected);
        EXPECT_FALSE(expected.empty());
        const Certificate certificate = certify(*solid, Elements(elements));
        EXPECT_GE(certificate.pieces, solid->surface().triangles.size());
    }
}

TEST(ElementCertificate, ATriangleInOneBallIsProvedJustWhereTheBodyHoldsItsCorners) {
    // Corners at the ball to the last bits, where distance and squared distance may disagree.
    Random random(5);
    int held = 0, at = 0;
    Element far{.kind = Kind::box, .half = {0.01, 0.01, 0.01}}; // spheres alone have a proof of their own
    far.pose.translation = {5, 0, 0};
    const Elements ball{{{{}, 1}}, {far}};
    for (int k = 0; k < 3000; ++k) {
        const Vec3 direction = test::random_direction(random);
        const double slack = Bodies(ball, {}, 1, 120).slack(0);
        const Vec3 p = direction * (1 - slack + (k % 9 - 4) * 0x1p-53);
        const auto solid = Solid::make(Mesh{{p, -p, p * 0.5}, {{0, 1, 2}}});
        ASSERT_EQ(solid->bounds().center(), Vec3{});
        const Balls pieces(*solid, {}, 120);
        const Bodies bodies(ball, {}, pieces.extent(), 120);
        const bool holds = bodies.holds(0, p) && bodies.holds(0, -p);
        EXPECT_EQ(covers(*solid, ball), holds) << k;
        EXPECT_EQ(certify(*solid, ball).holds, holds) << k;
        held += holds;
        at += !holds && bodies.growth(0, p) == 0;
    }
    EXPECT_GT(held, 500);
    EXPECT_LT(held, 2500);
    EXPECT_GT(at, 5);
}

} // namespace
