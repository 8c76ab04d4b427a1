// foam::spherize() on geometry that no tool likes: the cover is proved, whatever the mesh.
#include "geometry/shapes.hpp"

#include <foam/base/error.hpp>
#include <foam/runtime/contract.hpp>
#include <foam/search/spherize.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using namespace foam;

void expect_covered(const Mesh& mesh) {
    const auto solid = Solid::make(mesh);
    for (const std::size_t count : {1, 2, 5, 13}) {
        const SphereCover cover = spherize(*solid, count, {.effort = Effort::fast});
        EXPECT_GE(cover.spheres.size(), 1u);
        EXPECT_LE(cover.spheres.size(), count);
        EXPECT_TRUE(cover.certificate.holds) << count << " spheres";
        EXPECT_TRUE(certify(*solid, cover.spheres).holds) << count << " spheres";
    }
}

Mesh moved(Mesh mesh, const Vec3& by, double scale = 1) {
    return transformed(mesh, {.translation = by}, {scale, scale, scale});
}

TEST(NastyMeshes, PlateWithoutThickness) {
    expect_covered({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}});
}

TEST(NastyMeshes, ThinPlate) {
    expect_covered(test::box({0, 0, 0}, {1, 1, 1e-5}));
}

TEST(NastyMeshes, PartOfATenthOfAMicrometre) {
    expect_covered(moved(test::torus(1, 0.3), {}, 1e-7));
}

TEST(NastyMeshes, FarFromTheOrigin) {
    expect_covered(moved(sample::bracket(), {1e5, -1e5, 1e5}));
}

TEST(NastyMeshes, LargeAsACity) {
    expect_covered(moved(sample::bracket(), {}, 1e5));
}

TEST(NastyMeshes, SliversAndPoints) {
    expect_covered(
        {{{0, 0, 0}, {1, 0, 0}, {0.5, 1e-12, 0}, {0.2, 0.2, 0.2}}, {{0, 1, 2}, {0, 0, 0}, {3, 3, 3}, {0, 3, 3}}});
}

TEST(NastyMeshes, OnePoint) {
    expect_covered({{{1, 2, 3}}, {{0, 0, 0}}});
}

TEST(NastyMeshes, OnePointTooFarAwayIsRefused) {
    expect_covered({{{1, -1e9, 3}}, {{0, 0, 0}}});
    for (const double far : {1.1e9, 1e155, -1e308}) {
        try {
            spherize(Mesh{{{1, far, 3}}, {{0, 0, 0}}}, 3, {.effort = Effort::fast});
            ADD_FAILURE() << far;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::geometry);
            EXPECT_THAT(error.what(), testing::HasSubstr("its only point is "));
        }
    }
}

TEST(NastyMeshes, VerticesOfNoTriangle) {
    Mesh mesh = test::box({0, 0, 0}, {1, 1, 1});
    const SphereCover cover = spherize(mesh, 1);
    mesh.vertices.push_back({0, 0, 1e100});
    EXPECT_EQ(spherize(mesh, 1).spheres, cover.spheres);
}

TEST(NastyMeshes, OpenBox) {
    Mesh mesh = test::box({0, 0, 0}, {1, 1, 1});
    mesh.triangles.resize(mesh.triangles.size() - 3);
    expect_covered(mesh);
}

TEST(NastyMeshes, InsideOut) {
    expect_covered(test::flipped(sample::bracket()));
}

TEST(NastyMeshes, EverySampleOfTheContract) {
    for (const auto& [name, make] : sample::solids()) {
        SCOPED_TRACE(name);
        const auto solid = make();
        const SphereCover cover = spherize(*solid, 4, {.effort = Effort::fast});
        EXPECT_TRUE(certify(*solid, cover.spheres).holds);
    }
}

} // namespace
