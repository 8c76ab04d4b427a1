// Growth until the proof holds: never less than that, and not much more.
#include "geometry/few_spheres.hpp"
#include "geometry/shapes.hpp"

#include <foam/base/error.hpp>
#include <foam/geometry/measure.hpp>

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::test;

namespace {

std::vector<Sphere> row(int count, double length, double radius) {
    std::vector<Sphere> spheres;
    for (int i = 0; i < count; ++i) {
        spheres.push_back({{length * (i + 0.5) / count, 0.5, 0.5}, radius});
    }
    return spheres;
}

void expect_only_grown(const std::vector<Sphere>& before, const std::vector<Sphere>& after) {
    ASSERT_EQ(before.size(), after.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
        EXPECT_EQ(before[i].center, after[i].center);
        EXPECT_GE(after[i].radius, before[i].radius);
    }
}

} // namespace

TEST(Growth, OneSphereGrowsToTheFarthestCorner) {
    const auto cube = Solid::make(box({-1, -1, -1}, {1, 1, 1}));
    const auto grown = grown_to_cover(*cube, std::vector<Sphere>{{{0.5, 0, 0}, 0.1}});
    EXPECT_NEAR(grown[0].radius, std::sqrt(2.25 + 2), 1e-9);
    EXPECT_TRUE(certify(*cube, grown).holds);
}

TEST(Growth, WhatCoversStaysAsItIs) {
    const auto cube = Solid::make(box({-1, -1, -1}, {1, 1, 1}));
    const std::vector<Sphere> spheres{{{}, 2}, {{0.5, 0, 0}, 0.3}};
    EXPECT_EQ(grown_to_cover(*cube, spheres), spheres);
}

TEST(Growth, CreasesBetweenSpheresOnALongBox) {
    // The sections between the spheres' middles are 0.25 from them: a radius of 0.75 just reaches the edges there.
    const auto rod = Solid::make(box({0, 0, 0}, {4, 1, 1}));
    for (const double radius : {0.7, 0.7499, 0.75 - 1e-7}) {
        const auto before = row(8, 4, radius);
        const auto after = grown_to_cover(*rod, before);
        expect_only_grown(before, after);
        EXPECT_TRUE(certify(*rod, after).holds);
        double sum = 0;
        for (const Sphere& s : after) {
            sum += s.radius;
            EXPECT_LT(s.radius, 0.76);
        }
        EXPECT_LT(sum, 8 * 0.75 + 0.01);
    }
}

TEST(Growth, FarFromCovering) {
    Random random(5);
    for (int round = 0; round < 10; ++round) {
        const auto solid = Solid::make(torus(1, 0.3, 16));
        std::vector<Sphere> spheres;
        for (int i = 0; i < 6; ++i) {
            spheres.push_back({random_point(random, solid->bounds()), random.uniform(0, 0.2)});
        }
        const auto grown = grown_to_cover(*solid, spheres);
        expect_only_grown(spheres, grown);
        EXPECT_TRUE(certify(*solid, grown).holds);
    }
}

TEST(Growth, TakesTheSphereThatAddsLess) {
    // A corner sticks out between a small sphere, deep in the solid, and a large one outside all of it.
    const auto rod = Solid::make(box({0, 0, 0}, {2, 1, 1}));
    const auto grown = grown_to_cover(*rod, std::vector<Sphere>{{{0.5, 0.5, 0.5}, 0.9}, {{1.5, 0.5, 0.5}, 0.8}});
    EXPECT_TRUE(certify(*rod, grown).holds);
    EXPECT_DOUBLE_EQ(grown[0].radius, 0.9);
    EXPECT_NEAR(grown[1].radius, std::sqrt(0.75), 1e-9);
}

TEST(Growth, SameResultEveryTime) {
    const auto solid = Solid::make(torus(1, 0.3, 16));
    std::vector<Sphere> spheres;
    for (int i = 0; i < 7; ++i) {
        spheres.push_back({{std::cos(i), std::sin(i), 0}, 0.3});
    }
    EXPECT_EQ(grown_to_cover(*solid, spheres), grown_to_cover(*solid, spheres));
}

TEST(Growth, BallsThatMeetJustAtTheSurface) {
    // Found by the pipeline fuzzer (seed 1009619): a capsule 18 km long and 1.7 m thick.
    const Element capsule = Element::capsule(0.8576176610868728, 18374.68279787327);
    const auto solid = Solid::make(std::vector<Solid::Part>{{nullptr, capsule, {}}});
    const std::vector<Sphere> spheres{{{-3.8518515875030901, -2.4044942660744644, 323.02592617279447}, 3265.868687165816},
                                      {{0.51763487780607897, -3.670154495439224, 6424.3895125577264}, 2763.8120654918007},
                                      {{9.8289609637144579, 3.7554063182337396, -6101.3889711905904}, 3086.8280474083631}};
    EXPECT_TRUE(certify(*solid, grown_to_cover(*solid, spheres)).holds);
}

TEST(Growth, SpheresThatAreNone) {
    const auto cube = Solid::make(box({-1, -1, -1}, {1, 1, 1}));
    const double nan = std::nan("");
    EXPECT_THROW(grown_to_cover(*cube, std::vector<Sphere>{}), Error);
    EXPECT_THROW(grown_to_cover(*cube, std::vector<Sphere>{{{nan, 0, 0}, 1}}), Error);
    try {
        grown_to_cover(*cube, std::vector<Sphere>{{{}, std::numeric_limits<double>::infinity()}});
        ADD_FAILURE() << "no radius to grow from";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::geometry);
    }
    const auto grown = grown_to_cover(*cube, std::vector<Sphere>{{{nan, 0, 0}, 1}, {{}, 0}, {{}, -1}});
    EXPECT_TRUE(certify(*cube, grown).holds);
}

TEST(GrowthStays, OfSpheresInASlab) {
    expect_radii(grown_to_cover(*slab, six_in_slab()),
                 {0.379173201, 0.826706883, 0.263667805, 1.12632217, 0.275910003, 0.14756674});
}

TEST(GrowthStays, OfRoundParts) {
    const std::vector<double> radii{0.223702837, 0.180396673, 0.205523461, 0.166861306};
    expect_radii(grown_to_cover(*round_parts(), four_in_round_parts), radii);
}

TEST(Growth, RoundPrimitivesInClosedForm) {
    const auto ball = primitive_solid(Element::sphere(0.25));
    EXPECT_DOUBLE_EQ(grown_to_cover(*ball, std::vector<Sphere>{{{}, 0.2499}})[0].radius, 0.25);
    const auto capsule = primitive_solid(Element::capsule(0.25, 1));
    EXPECT_NEAR(grown_to_cover(*capsule, std::vector<Sphere>{{{}, 0.7499}})[0].radius, 0.75, 1e-9);
    const auto in_pieces = grown_to_cover(*capsule, std::vector<Sphere>{{{0, 0, 0.4}, 0.3}, {{0, 0, -0.4}, 0.3}, {{}, 0.3}});
    EXPECT_TRUE(certify(*capsule, in_pieces).holds);
    for (const Sphere& s : in_pieces) {
        EXPECT_LT(s.radius, 0.5);
    }
}

TEST(Growth, FlatAndOpenAndTiny) {
    Mesh plane;
    plane.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    plane.triangles = {{0, 1, 2}, {0, 2, 3}};
    const auto flat = Solid::make(plane);
    EXPECT_TRUE(certify(*flat, grown_to_cover(*flat, std::vector<Sphere>{{{0.2, 0.5, 0}, 0.1}, {{0.8, 0.5, 0}, 0.1}})).holds);
    const auto tiny = Solid::make(transformed(torus(1, 0.3, 12), {}, {1e-7, 1e-7, 1e-7}));
    EXPECT_TRUE(certify(*tiny, grown_to_cover(*tiny, std::vector<Sphere>{{{}, 1e-8}, {{1e-7, 0, 0}, 1e-8}})).holds);
    Pose far;
    far.translation = {1e4, 0, 0};
    const auto away = Solid::make(transformed(torus(1, 0.3, 12), far));
    const auto grown = grown_to_cover(*away, std::vector<Sphere>{{far.translation, 0.1}, {far.translation + Vec3{1, 0, 0}, 0.5}});
    EXPECT_TRUE(certify(*away, grown).holds);
}

TEST(Growth, ARoundPartIsClosedByTheBallThatNeedsLeast) {
    const auto ball = primitive_solid(Element::sphere(0.25));
    std::vector<Sphere> spheres = grown_to_cover(*ball, std::vector<Sphere>{{{}, 0.2499}});
    EXPECT_EQ(spheres[0].radius, 0.25) << "exact, not by pieces of its tessellation";
    const Sphere near{{0.0005, 0, 0}, 0.25}, exact{{}, 0.2499}, far{{0.1, 0, 0}, 0.2}, deep{{0.001, 0, 0}, 0.2498};
    for (const auto& [given, best] :
         {std::pair(std::vector{near, exact}, 1u), std::pair(std::vector{exact, near}, 0u),
          std::pair(std::vector{far, exact, deep}, 1u), std::pair(std::vector{far, deep, exact, near}, 2u)}) {
        spheres = grown_to_cover(*ball, given);
        for (std::size_t i = 0; i < spheres.size(); ++i) {
            EXPECT_EQ(spheres[i].radius, i == best ? 0.25 : given[i].radius) << i;
        }
    }
    // Where no ball is near enough, pieces grow them; where one holds the part already, none grows.
    spheres = grown_to_cover(*ball, std::vector<Sphere>{{{0, 0, 0.1}, 0.2}, {{0, 0, -0.1}, 0.2}});
    EXPECT_TRUE(certify(*ball, spheres).holds);
    EXPECT_GE(spheres[0].radius, 0.2);
    EXPECT_GE(spheres[1].radius, 0.2);
    spheres = grown_to_cover(*ball, std::vector<Sphere>{{{0.3, 0, 0}, 0.2}});
    EXPECT_NEAR(spheres[0].radius, 0.55, 0.01);
    spheres = grown_to_cover(*ball, std::vector<Sphere>{{{}, 0.3}, {{}, 0.2499}});
    EXPECT_EQ(spheres[0].radius, 0.3);
    EXPECT_EQ(spheres[1].radius, 0.2499);
}

TEST(Growth, OfTheFourNearestTheOneThatAddsLeast) {
    // About a speck: a small ball is farther off than large ones, and adds less.
    const double size = 1e-3;
    const auto speck = Solid::make(Mesh{{{0, 0, 0}, {size, 0, 0}, {0, size, 0}}, {{0, 1, 2}}});
    const Sphere small{{0, 0, 0.3}, 0.1};
    const std::vector<Sphere> large{{{1.11, 0, 0}, 1}, {{-1.12, 0, 0}, 1}, {{0, 1.13, 0}, 1}, {{0, -1.14, 0}, 1}};
    for (std::size_t count = 1; count <= large.size(); ++count) {
        std::vector<Sphere> spheres(large.begin(), large.begin() + static_cast<std::ptrdiff_t>(count));
        spheres.push_back(small);
        const std::vector<Sphere> before = std::exchange(spheres, grown_to_cover(*speck, spheres));
        EXPECT_TRUE(certify(*speck, spheres).holds);
        EXPECT_EQ(spheres.back() != small, count < 4) << count;
        for (std::size_t i = 0; count < 4 && i < count; ++i) {
            EXPECT_EQ(spheres[i], before[i]);
        }
    }
}

TEST(Growth, OfThoseThatAddNothingOutsideTheOneWhoseVolumeGrowsLeast) {
    // Within a large ball that ends just below a speck: its neighbours grow inside it.
    const double size = 1e-4;
    const auto speck = Solid::make(Mesh{{{0, 0, 0}, {size, 0, 0}, {0, size, 0}}, {{0, 1, 2}}});
    const Sphere large{{0, 0, -5}, 4.99}, medium{{0, 0, -2}, 1.98}, near{{0, 0, -2}, 1.999}, small{{0, 0, -0.5}, 0.47},
        unit{{0, 0, -1}, 0.985};
    for (const auto& [best, other] : {std::pair(unit, medium), std::pair(near, small)}) {
        for (const std::vector<Sphere>& before : {std::vector{large, best, other}, std::vector{other, best, large}}) {
            const std::vector<Sphere> spheres = grown_to_cover(*speck, before);
            EXPECT_GT(spheres[1].radius, best.radius);
            EXPECT_EQ(spheres[0], before[0]);
            EXPECT_EQ(spheres[2], before[2]);
        }
    }
}

TEST(Growth, ARoundPartThatIsHeldSaysNothingOfTheOther) {
    const auto solid = Solid::make(
        {{nullptr, Element::sphere(0.25), Pose{}},
         {nullptr, Element::sphere(0.1), Pose::from_xyz_rpy({1, 0, 0}, {0, 0, 0})}});
    for (const Sphere& small : {Sphere{{}, 0.2}, Sphere{{0.2, 0, 0}, 0.01}}) {
        const std::vector<Sphere> spheres = grown_to_cover(*solid, std::vector<Sphere>{{{1, 0, 0}, 0.1}, small});
        EXPECT_TRUE(certify(*solid, spheres).holds);
        EXPECT_EQ(spheres[0].radius, 0.1);
    }
}
