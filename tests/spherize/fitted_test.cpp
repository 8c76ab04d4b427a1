// Guarantee fitted: what is claimed wrongly and what is left out, together.
#include "all_spherizers.hpp"

#include <foam/geometry/measure.hpp>
#include <foam/runtime/contract.hpp>
#include <foam/search/refine.hpp>

#include <gtest/gtest.h>

#include <numbers>

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
        EXPECT_LT(misfit(*solid, far), 0.45) << name;
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
    const std::vector<Sphere> spheres = fitted::fit(*capsule(r, 1), std::vector<Sphere>{{{}, 0.6}}, 1, Reach::far);
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

TEST(Fit, WithoutVolumeNothingChanges) {
    Mesh sheet;
    sheet.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    sheet.triangles = {{0, 1, 2}};
    const std::vector<Sphere> start{{{0.3, 0.3, 0}, 0.8}};
    EXPECT_EQ(fitted::fit(*Solid::make(sheet), start, 4, Reach::far), start);
}

} // namespace
