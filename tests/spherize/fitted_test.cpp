// Guarantee fitted: what is claimed wrongly and what is left out, together.
#include "all_spherizers.hpp"

#include <foam/geometry/measure.hpp>
#include <foam/runtime/contract.hpp>
#include <foam/search/refine.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <optional>

namespace {

using namespace foam;
using namespace foam::test;
using fitted::Reach;

double misfit(const Solid& solid, std::span<const Sphere> spheres) {
    MeasureOptions options;
    options.surface_points = options.directions_per_sphere = 100;
    const Measures measures = measure(solid, spheres, options);
    return measures.excess + measures.missing;
}

std::shared_ptr<const Solid> capsule(double radius, double straight) {
    return Solid::make({Solid::Part{nullptr, Element::capsule(radius, straight), {}}});
}

/// The symmetric difference.
constexpr fitted::FitWeights volumes_alone{.excess = 1, .missing = 1, .distance = 0, .gap = 0};

class Fitted : public testing::TestWithParam<std::string> {};

TEST_P(Fitted, ClaimsAndMissesLessThanSpheresThatCover) {
    const auto stage = all_spherizers().make<Spherizer>(GetParam());
    for (const std::string name : {"Box", "Bracket", "Torus"}) {
        const auto solid = sample::solids().at(name)();
        QuietContext context;
        const SphereTree tree = stage->spherize({name, solid, solid}, {8, {}, Guarantee::fitted}, context);
        const double before = misfit(*solid, tree.finest());
        const std::vector<Sphere> near = fitted::fit(*solid, tree.finest(), 8, Reach::near);
        const std::vector<Sphere> far = fitted::fit(*solid, tree.finest(), 8, Reach::far);
        EXPECT_EQ(near.size(), tree.finest().size()) << name;
        EXPECT_LE(far.size(), 8u) << name;
        EXPECT_LT(misfit(*solid, near), 0.9 * before) << name;
        EXPECT_LT(misfit(*solid, far), 0.7 * before) << name;
        EXPECT_LT(misfit(*solid, far), 0.5) << name;
        EXPECT_EQ(fitted::fit(*solid, tree.finest(), 8, Reach::far), far) << "the same every time";
    }
}

INSTANTIATE_TEST_SUITE_P(Spherizers, Fitted, testing::ValuesIn(spherizer_names()),
                         [](const auto& test) { return test.param.substr(test.param.find('.') + 1); });

TEST(Fit, ABallIsItself) {
    const auto ball = sample::solids().at("BallPrimitive")();
    const double radius = std::cbrt(ball->volume() * 3 / (4 * std::numbers::pi));
    const std::vector<Sphere> spheres = fitted::fit(
        *ball, std::vector<Sphere>{{ball->bounds().center() + Vec3{0.3 * radius, 0, 0}, 1.7 * radius}}, 1, Reach::far);
    ASSERT_EQ(spheres.size(), 1u);
    EXPECT_NEAR(spheres[0].radius, radius, 0.02 * radius);
    EXPECT_LT(distance(spheres[0].center, ball->bounds().center()), 0.01 * radius);
}

TEST(Fit, TheSphereOfACapsuleHasHalfItsSurfaceInside) {
    // On the axis a ball of radius R > r has the share √(1 − (r/R)²) of its surface beyond the tube, on both sides:
    // half of it at R = 2r/√3, as long as the caps are farther away.
    const double r = 0.1;
    const std::vector<Sphere> spheres =
        fitted::fit(*capsule(r, 1), std::vector<Sphere>{{{}, 0.6}}, 1, Reach::far, volumes_alone);
    ASSERT_EQ(spheres.size(), 1u);
    EXPECT_NEAR(spheres[0].radius, 2 * r / std::sqrt(3.0), 0.02 * r);
}

TEST(Fit, ACapsuleByARow) {
    const auto solid = capsule(0.1, 0.4);
    std::vector<Sphere> row;
    for (int i = 0; i < 5; ++i) {
        row.push_back({{0, 0, -0.2 + 0.1 * i}, 0.12});
    }
    const double before = misfit(*solid, row);
    const std::vector<Sphere> spheres = fitted::fit(*solid, row, 5, Reach::near);
    EXPECT_LT(misfit(*solid, spheres), 0.5 * before);
    EXPECT_LT(misfit(*solid, spheres), 0.06);
}

TEST(Fit, TakesTheSpheresThatItMayHave) {
    const auto box = sample::solids().at("Box")();
    const Sphere one{box->bounds().center(), box->bounds().diagonal() / 2};
    EXPECT_EQ(fitted::fit(*box, std::vector<Sphere>{one}, 12, Reach::far).size(), 12u);
    EXPECT_EQ(fitted::fit(*box, std::vector<Sphere>{one}, 12, Reach::near).size(), 1u);
}

/// A handle and a shaft of a twenty-fifth of its volume.
std::shared_ptr<const Solid> screwdriver() {
    return Solid::make({Solid::Part{nullptr, Element::cylinder(0.015, 0.11), {}},
                        Solid::Part{nullptr, Element::cylinder(0.003, 0.12), {.translation = {0, 0, 0.115}}}});
}

double gap(const Solid& solid, std::span<const Sphere> spheres) {
    return measure(solid, spheres, {.surface_points = 100, .volume_rays = 100, .directions_per_sphere = 10}).gap;
}

double mean_distance(const Solid& solid, std::span<const Sphere> spheres) {
    double sum = 0;
    const std::vector<SurfacePoint> points = solid.sample_surface(5000, 3);
    for (const SurfacePoint& point : points) {
        double least = std::numeric_limits<double>::infinity();
        for (const Sphere& sphere : spheres) {
            least = std::min(least, distance(point.point, sphere.center) - sphere.radius);
        }
        sum += std::max(least, 0.0) / static_cast<double>(points.size());
    }
    return sum;
}

std::vector<Sphere> fitted_with(const Solid& solid, std::size_t count, const fitted::FitWeights& weights,
                                std::optional<double> max_gap = {}) {
    const std::vector<Sphere> start{{solid.bounds().center(), solid.bounds().diagonal() / 2}};
    return fitted::fit(solid, start, count, Reach::far, weights, max_gap);
}

TEST(Fit, AThinPartIsNotLeftOut) {
    const auto solid = screwdriver();
    const std::vector<Sphere> by_volume = fitted_with(*solid, 8, volumes_alone);
    EXPECT_GT(gap(*solid, by_volume), 0.03) << "the shaft's volume alone is worth few spheres";
    const std::vector<Sphere> spheres = fitted_with(*solid, 8, {});
    EXPECT_LT(gap(*solid, spheres), 0.01);
    EXPECT_LT(mean_distance(*solid, spheres), 0.5 * mean_distance(*solid, by_volume));
}

TEST(Fit, WeightsMoveTheBalance) {
    const auto box = sample::solids().at("Box")();
    const auto volumes = [&](const fitted::FitWeights& weights) {
        return excess_and_missing_volume(*box, fitted_with(*box, 6, weights));
    };
    const auto [excess, missing] = volumes({});
    EXPECT_LT(volumes({.excess = 5}).first, 0.8 * excess);
    EXPECT_LT(volumes({.missing = 5}).second, 0.8 * missing);
    const std::vector<Sphere> usual = fitted_with(*box, 6, {});
    EXPECT_LT(mean_distance(*box, fitted_with(*box, 6, {.distance = 5})), 0.8 * mean_distance(*box, usual));
    EXPECT_LT(gap(*box, fitted_with(*box, 6, {.gap = 2})), 0.8 * gap(*box, usual));
}

TEST(Fit, TheLargestGapIsKept) {
    for (const std::string name : {"Box", "Bracket", "Torus"}) {
        const auto solid = sample::solids().at(name)();
        const double before = gap(*solid, fitted_with(*solid, 3, {}));
        for (const double share : {0.7, 0.1, 0.001}) {
            const std::vector<Sphere> spheres = fitted_with(*solid, 3, {}, share * before);
            EXPECT_LE(spheres.size(), 3u);
            EXPECT_LE(gap(*solid, spheres), share * before) << name << " " << share;
        }
        EXPECT_EQ(fitted_with(*solid, 3, {}, 2 * before), fitted_with(*solid, 3, {})) << "as it keeps it anyway";
    }
}

TEST(Fit, WithoutVolumeNothingChanges) {
    Mesh sheet;
    sheet.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    sheet.triangles = {{0, 1, 2}};
    const std::vector<Sphere> start{{{0.3, 0.3, 0}, 0.8}};
    EXPECT_EQ(fitted::fit(*Solid::make(sheet), start, 4, Reach::far), start);
}

} // namespace
