// The two steps of growth: balls grow until all is covered, and shrink to what they need.
#include "geometry/few_spheres.hpp"
#include "geometry/src/proof/growth.hpp"

#include <foam/geometry/measure.hpp>

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::test;

TEST(GrowthStays, ByCellsWhereLooksEnd) {
    std::vector<Sphere> spheres = six_in_slab();
    geometry::grow(*slab, spheres, 7);
    EXPECT_TRUE(certify(*slab, spheres).holds);
    expect_radii(spheres, {0.593691541, 0.722856585, 0.574655504, 1.12632217, 0.653782344, 0.876584876});
    spheres = six_in_slab();
    spheres.push_back({{50, 0, 0}, 0});
    geometry::grow(*slab, spheres, 7);
    EXPECT_EQ(spheres.back().radius, 0) << "nothing asks for it";
    spheres = four_in_round_parts;
    geometry::grow(*round_parts(), spheres, 7);
    EXPECT_TRUE(certify(*round_parts(), spheres).holds);
    expect_radii(spheres, {0.206141719, 0.197216654, 0.206048817, 0.196243621});
    spheres = six_in_slab();
    geometry::grow(*slab, spheres, 0);
    expect_radii(spheres, {0.593691541, 0.722856585, 0.574655504, 1.12632217, 0.653782344, 0.876584876});
    EXPECT_EQ(geometry::most_looks(*slab), 20'240u);
}

TEST(GrowthStays, NeededRadii) {
    const std::vector<Sphere> cover = twenty_over_slab();
    ASSERT_TRUE(certify(*slab, cover).holds);
    const geometry::Balls balls(*slab, cover, geometry::growth_halvings, geometry::growth_caution);
    for (const auto& [i, radius, looked_at] :
         {std::tuple(0u, 0.332603367, 157u), std::tuple(3u, 0.332603367, 129u), std::tuple(6u, 0.0, 153u),
          std::tuple(9u, 0.0, 92u), std::tuple(12u, 0.0, 54u), std::tuple(15u, 0.30683187, 393u),
          std::tuple(18u, 0.320000996, 366u)}) {
        geometry::Balls own = balls;
        std::size_t looks = 1'000;
        EXPECT_NEAR(geometry::needed_radius(own, i, cover[i].radius, looks), radius, 2e-9);
        EXPECT_EQ(looks, 1'000u - looked_at) << "pieces that can change nothing are not looked at";
        own = balls;
        looks = 8;
        EXPECT_NEAR(geometry::needed_radius(own, i, cover[i].radius, looks), cover[i].radius, 1e-12)
            << "not known better";
        EXPECT_EQ(looks, 0u);
        if (radius > 0) {
            std::vector<Sphere> least = cover;
            least[i].radius = radius + 1e-8;
            EXPECT_TRUE(certify(*slab, least).holds);
            least[i].radius = radius - 1e-5;
            EXPECT_FALSE(certify(*slab, least).holds);
        }
    }
}

TEST(GrowthStays, ShrunkCovers) {
    std::vector<Sphere> spheres = twenty_over_slab();
    const std::vector<double> floor(20, 0.1);
    geometry::shrink(*slab, spheres, floor);
    expect_radii(spheres, {0.332603367, 0.332603367, 0.332603367, 0.332603367, 0.338710792, 0.338710792, 0.338710792,
                           0.409389789, 0.345000002, 0.408900964, 0.296811053, 0.296811053, 0.419999998, 0.236582234,
                           0.419999998, 0.419999999, 0.358085185, 0.419999995, 0.358085185, 0.358085185});
}

TEST(Growth, SpheresThatAreNoneArePassedOver) {
    const auto ball = primitive_solid(Element::sphere(0.25));
    const double infinity = std::numeric_limits<double>::infinity();
    std::vector<Sphere> spheres{{{}, infinity}, {{}, 0.2499}, {{std::nan(""), 0, 0}, 0.3}};
    geometry::grow(*ball, spheres, 1000);
    EXPECT_EQ(spheres[1].radius, 0.25);
}

TEST(Growth, NoSphereShrinks) {
    // Not even one whose square is no number, which holds nothing.
    std::vector<Sphere> spheres{{{}, 1e160}};
    geometry::grow(*slab, spheres, 1000);
    EXPECT_EQ(spheres[0].radius, 1e160);
}

TEST(Growth, ARoundPartIsClosedWithinAShareOfItsRadius) {
    const auto ball = primitive_solid(Element::sphere(4));
    for (const auto& [radius, closed] : {std::pair(3.985, true), std::pair(3.97, false)}) {
        std::vector<Sphere> spheres{{{}, radius}};
        geometry::grow(*ball, spheres, 100'000);
        EXPECT_EQ(spheres[0].radius == 4, closed) << radius;
        EXPECT_TRUE(certify(*ball, spheres).holds);
    }
}

namespace {

/// Two balls as primitives: one of radius 1/4 about the origin, the other beside it.
std::shared_ptr<const Solid> two_balls(double away, double radius) {
    return Solid::make(
        {{nullptr, Element::sphere(0.25), Pose{}},
         {nullptr, Element::sphere(radius), Pose::from_xyz_rpy({away, 0, 0}, {0, 0, 0})}});
}

/// What the first sphere needs.
double needed(const Solid& solid, const std::vector<Sphere>& spheres, std::size_t looks = 100'000) {
    geometry::Balls balls(solid, spheres, geometry::growth_halvings, geometry::growth_caution);
    return geometry::needed_radius(balls, 0, spheres[0].radius, looks);
}

} // namespace

TEST(Shrinking, WhatOthersCoverNeedsNothing) {
    EXPECT_EQ(needed(*slab, {{{}, 0.5}, {{}, 2}}), 0);
    EXPECT_EQ(needed(*two_balls(1, 0.1), {{{}, 2}, {{0.5, 0, 0}, 2}}), 0);
}

TEST(Shrinking, ARoundPartNeedsItsRadiusExactly) {
    EXPECT_EQ(needed(*primitive_solid(Element::sphere(0.25)), {{{}, 0.3}}), 0.25);
    EXPECT_EQ(needed(*primitive_solid(Element::sphere(0.25)), {{{}, 0.25}}), 0.25);
    EXPECT_EQ(needed(*primitive_solid(Element::sphere(3)), {{{}, 5}}), 3);
    EXPECT_EQ(needed(*two_balls(0.3, 0.1), {{{}, 1}, {{0.3, 0, 0}, 0.1}}), 0.25) << "another holds the second";
    EXPECT_EQ(needed(*two_balls(0.3, 0.1), {{{0.3, 0, 0}, 1}, {{}, 0.25}}), 0.1) << "another holds the first";
    const std::vector<Sphere> shared{{{}, 0.9}, {{1.1, 0, 0}, 0.3}, {{0.9, 0, 0}, 0.3}};
    EXPECT_EQ(needed(*two_balls(1, 0.25), shared), 0.25) << "others share the second";
    EXPECT_NEAR(needed(*two_balls(0.3, 0.25), {{{}, 0.6}}), 0.55, 1e-9) << "it alone holds both";
    EXPECT_NEAR(needed(*two_balls(0.3, 0.25), {{{0.3, 0, 0}, 0.6}}), 0.55, 1e-9);
    const auto with_box = Solid::make({{nullptr, Element::sphere(0.25), Pose{}},
                                       {std::make_shared<const Mesh>(box({0.3, 0, 0}, {0.4, 0.1, 0.1})), {}, {}}});
    EXPECT_NEAR(needed(*with_box, {{{}, 1}}), std::sqrt(0.18), 1e-9) << "what is not round counts, too";
    // Of the second it holds what another leaves over.
    const std::vector<Sphere> part{{{}, 0.7}, {{0.8, 0, 0}, 0.3}};
    const double radius = needed(*two_balls(0.6, 0.25), part);
    EXPECT_NEAR(radius, 0.678, 0.01);
    EXPECT_TRUE(certify(*two_balls(0.6, 0.25), std::vector<Sphere>{{{}, radius + 1e-8}, part[1]}).holds);
}

TEST(Shrinking, WhatIsKnownWhenLooksEndIsKept) {
    // Nothing, then what pieces of the round parts need, then what the parts need.
    const auto solid = two_balls(1, 0.25);
    const std::vector<Sphere> shared{{{}, 0.9}, {{1.1, 0, 0}, 0.3}, {{0.9, 0, 0}, 0.3}};
    std::size_t unknown = 0, by_pieces = 0, exact = 0;
    for (std::size_t looks = 0; looks < 10'000 && exact == 0; looks += looks / 20 + 1) {
        const double radius = needed(*solid, shared, looks);
        EXPECT_GE(radius, 0.25);
        EXPECT_LE(radius, 0.9 + 1e-9);
        (radius == 0.25 ? exact : radius < 0.3 ? by_pieces : unknown) += 1;
    }
    EXPECT_GT(unknown, 0u);
    EXPECT_GT(by_pieces, 0u);
    EXPECT_GT(exact, 0u);
}

TEST(Shrinking, NeverGrows) {
    const std::vector<Sphere> before = twenty_over_slab();
    std::vector<Sphere> spheres = before;
    geometry::shrink(*slab, spheres, std::vector<double>(20, 0.1));
    for (std::size_t i = 0; i < before.size(); ++i) {
        EXPECT_LE(spheres[i].radius, before[i].radius);
    }
    EXPECT_TRUE(certify(*slab, spheres).holds);
}
