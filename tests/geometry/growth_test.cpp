// Growth until the proof holds: never less than that, and not much more.
#include "geometry/shapes.hpp"

#include <foam/error.hpp>
#include <foam/measure.hpp>

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
    const auto grown = grown_to_cover(*cube, {{{0.5, 0, 0}, 0.1}});
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

TEST(Growth, RadiiAreMultiplesOfTheQuantum) {
    const auto solid = Solid::make(torus(1, 0.3, 20));
    std::vector<Sphere> spheres;
    for (int i = 0; i < 10; ++i) {
        const double angle = 2 * std::numbers::pi * i / 10;
        spheres.push_back({{std::cos(angle), std::sin(angle), 0}, 0.4});
    }
    for (const double quantum : {1e-6, 1e-3, 0.05}) {
        const auto grown = grown_to_cover(*solid, spheres, quantum);
        EXPECT_TRUE(certify(*solid, grown).holds);
        for (const Sphere& s : grown) {
            EXPECT_NEAR(s.radius / quantum, std::round(s.radius / quantum), 1e-6);
        }
        // Holds for the decimal numbers that a file would have.
        auto shaken = grown;
        for (Sphere& s : shaken) {
            s.radius = std::nextafter(s.radius, 0);
        }
        EXPECT_TRUE(certify(*solid, shaken).holds);
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
    const auto grown = grown_to_cover(*rod, {{{0.5, 0.5, 0.5}, 0.9}, {{1.5, 0.5, 0.5}, 0.8}});
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
    EXPECT_EQ(tightened_to_cover(*solid, spheres), tightened_to_cover(*solid, spheres));
}

TEST(Growth, SpheresThatAreNone) {
    const auto cube = Solid::make(box({-1, -1, -1}, {1, 1, 1}));
    const double nan = std::nan("");
    EXPECT_THROW(grown_to_cover(*cube, {}), Error);
    EXPECT_THROW(grown_to_cover(*cube, {{{nan, 0, 0}, 1}}), Error);
    const auto grown = grown_to_cover(*cube, {{{nan, 0, 0}, 1}, {{}, 0}, {{}, -1}});
    EXPECT_TRUE(certify(*cube, grown).holds);
}

TEST(Growth, RoundPrimitivesInClosedForm) {
    const auto ball = primitive_solid({Primitive::Kind::sphere, {}, 0.25, 0});
    EXPECT_DOUBLE_EQ(grown_to_cover(*ball, {{{}, 0.2499}})[0].radius, 0.25);
    const auto capsule = primitive_solid({Primitive::Kind::capsule, {}, 0.25, 1});
    EXPECT_NEAR(grown_to_cover(*capsule, {{{}, 0.7499}})[0].radius, 0.75, 1e-9);
    const auto in_pieces = grown_to_cover(*capsule, {{{0, 0, 0.4}, 0.3}, {{0, 0, -0.4}, 0.3}, {{}, 0.3}});
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
    EXPECT_TRUE(certify(*flat, grown_to_cover(*flat, {{{0.2, 0.5, 0}, 0.1}, {{0.8, 0.5, 0}, 0.1}})).holds);
    const auto tiny = Solid::make(transformed(torus(1, 0.3, 12), {}, {1e-7, 1e-7, 1e-7}));
    EXPECT_TRUE(certify(*tiny, grown_to_cover(*tiny, {{{}, 1e-8}, {{1e-7, 0, 0}, 1e-8}})).holds);
    Pose far;
    far.translation = {1e4, 0, 0};
    const auto away = Solid::make(transformed(torus(1, 0.3, 12), far));
    const auto grown = grown_to_cover(*away, {{far.translation, 0.1}, {far.translation + Vec3{1, 0, 0}, 0.5}});
    EXPECT_TRUE(certify(*away, grown).holds);
}

TEST(Tightening, NoSphereIsLargerThanItMustBe) {
    const auto rod = Solid::make(box({0, 0, 0}, {4, 1, 1}));
    const auto tight = tightened_to_cover(*rod, row(8, 4, 1.2));
    EXPECT_TRUE(certify(*rod, tight).holds);
    EXPECT_LT(union_volume(tight), union_volume(row(8, 4, 0.76)));
    for (std::size_t i = 0; i < tight.size(); ++i) {
        auto smaller = tight;
        smaller[i].radius -= 1e-4;
        const bool inside = rod->signed_distance(tight[i].center) <= -tight[i].radius + 1e-6;
        EXPECT_TRUE(inside || !certify(*rod, smaller).holds) << "sphere " << i;
    }
}

TEST(Tightening, KeepsWhatLiesInside) {
    const auto cube = Solid::make(box({-1, -1, -1}, {1, 1, 1}));
    const auto tight = tightened_to_cover(*cube, {{{}, 2}, {{0.2, 0, 0}, 0.7}, {{0.5, 0, 0}, 3}});
    EXPECT_TRUE(certify(*cube, tight).holds);
    EXPECT_DOUBLE_EQ(tight[1].radius, 0.7) << "it adds nothing outside";
    EXPECT_LT(union_volume(tight), union_volume(std::vector<Sphere>{{{}, 1.74}}) * 1.02);
}
