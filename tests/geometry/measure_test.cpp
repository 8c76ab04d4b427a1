// The figures of a model on cases whose answers are known.
#include "geometry/shapes.hpp"

#include <foam/measure.hpp>

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::test;

namespace {

constexpr double pi = std::numbers::pi;

} // namespace

TEST(Measure, BallAroundACube) {
    const auto cube = Solid::make(box({-1, -1, -1}, {1, 1, 1}));
    const double radius = 1.8;
    const Measures m = measure(*cube, std::vector<Sphere>{{{}, radius}});
    const double ball = 4 / 3.0 * pi * radius * radius * radius;
    EXPECT_EQ(m.spheres, 1u);
    EXPECT_TRUE(m.certified);
    EXPECT_EQ(m.gap, 0);
    EXPECT_EQ(m.covered, 1);
    EXPECT_DOUBLE_EQ(m.area, 24);
    EXPECT_DOUBLE_EQ(m.volume, 8);
    EXPECT_NEAR(m.excess, ball / 8 - 1, 5e-3);
    EXPECT_NEAR(m.excess_volume, m.excess * 8, 1e-12);
    EXPECT_LT(m.excess_error, 5e-3);
    EXPECT_GT(m.excess_error, 0);
    EXPECT_EQ(m.missing, 0);
    EXPECT_NEAR(m.exposed_area, 4 * pi * radius * radius, 1e-9);
    EXPECT_NEAR(m.protrusion_max, 0.8, 1e-6) << "above the faces' middles";
    EXPECT_GT(m.protrusion_mean, radius - std::sqrt(3.0));
    EXPECT_LT(m.protrusion_mean, 0.8);
}

TEST(Measure, BallInACube) {
    const auto cube = Solid::make(box({-1, -1, -1}, {1, 1, 1}));
    const Measures m = measure(*cube, std::vector<Sphere>{{{}, 1}});
    EXPECT_FALSE(m.certified);
    EXPECT_NEAR(m.gap, std::sqrt(3.0) - 1, 2e-3);
    EXPECT_NEAR(m.covered, 0, 1e-4);
    EXPECT_NEAR(m.missing, 1 - pi / 6, 2e-3);
    EXPECT_NEAR(m.excess, 0, 1e-3);
    EXPECT_NEAR(m.protrusion_max, 0, 1e-12);
}

TEST(Measure, CoveredShare) {
    // A ball about a corner covers a quarter disc on three faces.
    const auto cube = Solid::make(box({0, 0, 0}, {1, 1, 1}));
    const Measures m = measure(*cube, std::vector<Sphere>{{{}, 0.5}});
    EXPECT_NEAR(m.covered, 3 * pi / 16 / 6, 2e-4);
    EXPECT_NEAR(m.missing, 1 - pi / 6 / 8, 1e-3);
    EXPECT_NEAR(m.excess, 7 * pi / 6 / 8, 2e-3);
    EXPECT_NEAR(m.gap, std::sqrt(3.0) - 0.5, 2e-3);
    EXPECT_NEAR(m.protrusion_max, 0.5, 1e-9);
}

TEST(Measure, TheErrorIsHonest) {
    const auto solid = Solid::make(torus(1, 0.3, 24));
    const std::vector<Sphere> spheres{{{1, 0, 0}, 0.5}, {{-1, 0, 0}, 0.4}, {{0, 1, 0}, 0.45}};
    MeasureOptions fine;
    fine.volume_rays = 600'000;
    const double truth = measure(*solid, spheres, fine).excess;
    int within_two = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        MeasureOptions options;
        options.seed = seed;
        options.volume_rays = 1200;
        options.surface_points = 10;
        const Measures m = measure(*solid, spheres, options);
        within_two += std::abs(m.excess - truth) <= 2 * m.excess_error;
        EXPECT_LT(std::abs(m.excess - truth), 6 * m.excess_error);
    }
    EXPECT_GE(within_two, 15);
}

TEST(Measure, LinesAndPointsAgree) {
    Mesh mesh = ball({}, 1, 16);
    const auto closed = Solid::make(mesh);
    mesh.triangles.pop_back();
    const auto open = Solid::make(mesh);
    const std::vector<Sphere> spheres{{{0.5, 0, 0}, 0.8}, {{-0.5, 0, 0}, 0.9}};
    const Measures a = measure(*closed, spheres), b = measure(*open, spheres);
    EXPECT_NEAR(a.excess, b.excess, 4 * b.excess_error + 2e-3);
    EXPECT_NEAR(a.missing, b.missing, 4 * b.missing_error + 2e-3);
    EXPECT_NEAR(a.protrusion_max, b.protrusion_max, 1e-3);
    EXPECT_NEAR(a.covered, b.covered, 2e-3);
}

TEST(Measure, NoSpheresAndNoVolume) {
    const auto cube = Solid::make(box({0, 0, 0}, {1, 1, 1}));
    const Measures none = measure(*cube, std::vector<Sphere>{{{}, 0}, {{std::nan(""), 0, 0}, 1}});
    EXPECT_EQ(none.spheres, 0u);
    EXPECT_EQ(none.covered, 0);
    EXPECT_NEAR(none.missing, 1, 1e-12);
    EXPECT_EQ(none.excess, 0);
    EXPECT_TRUE(std::isinf(none.gap));
    Mesh plane;
    plane.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
    plane.triangles = {{0, 1, 2}};
    const Measures flat = measure(*Solid::make(plane), std::vector<Sphere>{{{0.5, 0.5, 0}, 1}});
    EXPECT_TRUE(flat.certified);
    EXPECT_EQ(flat.volume, 0);
    EXPECT_TRUE(std::isinf(flat.excess));
    EXPECT_EQ(flat.missing, 0);
    EXPECT_NEAR(flat.excess_volume, 4 / 3.0 * pi, 0.05);
}

TEST(Measure, SameSeedSameNumbers) {
    const auto solid = Solid::make(torus(1, 0.3, 12));
    const std::vector<Sphere> spheres{{{1, 0, 0}, 0.5}, {{-1, 0, 0}, 0.4}};
    MeasureOptions options;
    options.seed = 3;
    const Measures a = measure(*solid, spheres, options), b = measure(*solid, spheres, options);
    EXPECT_EQ(a.excess, b.excess);
    EXPECT_EQ(a.missing, b.missing);
    EXPECT_EQ(a.covered, b.covered);
    EXPECT_EQ(a.protrusion_mean, b.protrusion_mean);
    options.seed = 4;
    EXPECT_NE(a.excess, measure(*solid, spheres, options).excess);
}

TEST(Measure, Total) {
    Measures a, b;
    a.spheres = 2, a.area = 1, a.volume = 1, a.covered = 1, a.excess_volume = 0.5, a.certified = true;
    a.exposed_area = 1, a.protrusion_max = 0.1, a.protrusion_mean = 0.05, a.excess_volume_error = 0.03;
    b.spheres = 3, b.area = 3, b.volume = 3, b.covered = 0.9, b.excess_volume = 0.7, b.missing_volume = 0.4;
    b.gap = 0.01, b.exposed_area = 3, b.protrusion_max = 0.2, b.protrusion_mean = 0.01, b.excess_volume_error = 0.04;
    const Measures sum = total(std::vector<Measures>{a, b});
    EXPECT_EQ(sum.spheres, 5u);
    EXPECT_DOUBLE_EQ(sum.excess, 0.3);
    EXPECT_DOUBLE_EQ(sum.excess_error, 0.05 / 4);
    EXPECT_DOUBLE_EQ(sum.missing, 0.1);
    EXPECT_DOUBLE_EQ(sum.covered, 0.925);
    EXPECT_DOUBLE_EQ(sum.gap, 0.01);
    EXPECT_DOUBLE_EQ(sum.protrusion_max, 0.2);
    EXPECT_DOUBLE_EQ(sum.protrusion_mean, 0.02);
    EXPECT_FALSE(sum.certified);
    EXPECT_FALSE(total({}).certified);
}
