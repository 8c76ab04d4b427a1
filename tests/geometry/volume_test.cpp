// Volumes of unions of parts and of balls.
#include "geometry/shapes.hpp"

#include <foam/measure.hpp>

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::test;

namespace {

constexpr double pi = std::numbers::pi;

Solid::Part mesh_part(Mesh mesh) {
    return {std::make_shared<const Mesh>(std::move(mesh)), std::nullopt, {}};
}

} // namespace

TEST(Volume, ExactWithoutOverlap) {
    const Mesh mesh = torus(1, 0.3, 40);
    EXPECT_NEAR(Solid::make(mesh)->volume(), signed_volume(mesh), 1e-12);
    const Mesh cavity = together(ball({}, 1), flipped(ball({}, 0.5)));
    EXPECT_NEAR(Solid::make(cavity)->volume(), signed_volume(cavity), 1e-12);
    const Mesh apart = together(box({0, 0, 0}, {1, 1, 1}), box({3, 0, 0}, {4, 1, 1}));
    EXPECT_DOUBLE_EQ(Solid::make(apart)->volume(), 2);
}

TEST(Volume, OverlappingBoxes) {
    const Mesh a = box({0, 0, 0}, {1, 1, 1}), b = box({0.5, 0.5, 0.5}, {1.5, 1.5, 1.5});
    EXPECT_NEAR(Solid::make(together(a, b))->volume(), 1.875, 2e-3);
    EXPECT_NEAR(Solid::make(std::vector{mesh_part(a), mesh_part(b)})->volume(), 1.875, 2e-3);
    EXPECT_NEAR(Solid::make(std::vector{mesh_part(a), mesh_part(a)})->volume(), 1, 2e-3);
}

TEST(Volume, PrimitiveInMesh) {
    const auto solid = Solid::make(std::vector<Solid::Part>{
        mesh_part(box({-1, -1, -1}, {1, 1, 1})),
        {nullptr, Primitive{Primitive::Kind::sphere, {}, 0.5, 0}, Pose::from_xyz_rpy({1, 0, 0}, {})}});
    EXPECT_NEAR(solid->volume(), 8 + 2 / 3.0 * pi * 0.125, 5e-3);
    EXPECT_TRUE(solid->contains({1.4, 0, 0}));
    EXPECT_FALSE(solid->contains({1.4, 0.4, 0}));
    EXPECT_LT(solid->signed_distance({0.9, 0, 0}), -0.39) << "deep in the sphere, near the box's face inside it";
}

TEST(Volume, OpenMesh) {
    Mesh mesh = ball({}, 1, 24);
    const double closed = signed_volume(mesh);
    mesh.triangles.resize(mesh.triangles.size() - 2);
    const auto solid = Solid::make(mesh);
    EXPECT_FALSE(solid->closed());
    EXPECT_NEAR(solid->volume() / closed, 1, 3e-3);
    EXPECT_EQ(solid->volume(), Solid::make(mesh)->volume()) << "the same every time";
}

TEST(UnionVolume, AnalyticCases) {
    const double unit = 4 / 3.0 * pi;
    EXPECT_EQ(union_volume({}), 0);
    const std::vector<Sphere> one{{{5, 6, 7}, 1}};
    EXPECT_NEAR(union_volume(one), unit, 1e-12 * 10);
    const std::vector<Sphere> same{{{}, 1}, {{}, 1}, {{0.1, 0, 0}, 0.5}};
    EXPECT_NEAR(union_volume(same), unit, 1e-5);
    const std::vector<Sphere> apart{{{}, 1}, {{3, 0, 0}, 0.5}};
    EXPECT_NEAR(union_volume(apart), unit * 1.125, 1e-3);
    // Two unit balls at distance d overlap in a lens of π (4 + d) (2 - d)² / 12.
    for (const double d : {0.3, 1.0, 1.9}) {
        const std::vector<Sphere> two{{{}, 1}, {{0, 0, d}, 1}};
        EXPECT_NEAR(union_volume(two), 2 * unit - pi * (4 + d) * (2 - d) * (2 - d) / 12, 0.01);
        EXPECT_NEAR(union_volume(two, 100'000), 2 * unit - pi * (4 + d) * (2 - d) * (2 - d) / 12, 2e-4);
    }
}

TEST(UnionVolume, IgnoresWhatIsNoBall) {
    const std::vector<Sphere> spheres{{{}, 1}, {{}, -3}, {{std::nan(""), 0, 0}, 2}, {{1, 0, 0}, 0}, {{}, std::nan("")}};
    EXPECT_NEAR(union_volume(spheres), 4 / 3.0 * pi, 1e-9);
}
