// Primitives: closed forms against their tessellation and against rays.
#include "geometry/shapes.hpp"

#include <foam/geometry/inscribed_mesh.hpp>

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::test;

namespace {

const std::vector<Element> primitives{Element::box({1, 2, 3}),
                                        Element::sphere(0.7),
                                        Element::cylinder(0.4, 1.5),
                                        Element::capsule(0.4, 1.5),
                                        Element::capsule(0.4, 0)};

} // namespace

TEST(Primitives, TessellationEnclosesAndIsClosed) {
    Random random(1);
    for (const Element& primitive : primitives) {
        for (const int segments : {3, 5, 8, 48}) {
            const Mesh mesh = enclosing_mesh(primitive, segments);
            const Topology t = topology(mesh);
            EXPECT_TRUE(t.closed_manifold()) << to_string(primitive.kind) << ' ' << describe(t);
            EXPECT_EQ(t.degenerate_triangles, 0u);
            const auto exact = primitive_solid(primitive);
            EXPECT_GE(signed_volume(mesh), exact->volume() * (1 - 1e-14));
            for (const SurfacePoint& p : Solid::make(mesh)->sample_surface(2000, 3)) {
                EXPECT_GE(exact->signed_distance(p.point), -1e-15);
            }
        }
    }
}

TEST(Primitives, DefaultTessellationIsClose) {
    for (const Element& primitive : primitives) {
        const auto solid = primitive_solid(primitive);
        EXPECT_NEAR(signed_volume(solid->surface()) / solid->volume(), 1, 0.01);
    }
}

TEST(Primitives, IcospheresLieWithinTheBall) {
    for (int k = 0; k < 5; ++k) {
        const Mesh mesh = icosphere(k);
        EXPECT_EQ(mesh.triangles.size(), 20u << 2 * k);
        EXPECT_TRUE(topology(mesh).closed_manifold());
        EXPECT_LT(signed_volume(mesh), 4 * std::numbers::pi / 3);
        EXPECT_GT(signed_volume(mesh), 4 * std::numbers::pi / 3 * (1 - 0.6 / (1 << 2 * k)));
        for (const Vec3& p : mesh.vertices) {
            EXPECT_NEAR(norm(p), 1, 1e-15);
        }
    }
}

TEST(Primitives, SignedDistanceIsTheDistanceToTheSurface) {
    Random random(2);
    for (const Element& primitive : primitives) {
        const Pose pose = random_pose(random, 2);
        const auto exact = primitive_solid(primitive, pose);
        const auto fine = Solid::make(transformed(enclosing_mesh(primitive, 400), pose));
        for (int i = 0; i < 300; ++i) {
            const Vec3 p = random_point(random, enlarged(exact->bounds(), 0.5));
            EXPECT_NEAR(exact->signed_distance(p), fine->signed_distance(p), 1e-4);
            EXPECT_EQ(exact->contains(p), exact->signed_distance(p) <= 0);
        }
    }
}

TEST(Primitives, LinesEndOnTheSurface) {
    Random random(3);
    for (const Element& primitive : primitives) {
        const auto solid = primitive_solid(primitive, random_pose(random, 2));
        int hits = 0;
        for (int i = 0; i < 300; ++i) {
            const Vec3 origin = random_point(random, enlarged(solid->bounds(), 0.5));
            const Vec3 direction = random_direction(random) * 2;
            const auto intervals = solid->inside_along(origin, direction);
            ASSERT_LE(intervals.size(), 1u);
            for (const auto& [enter, leave] : intervals) {
                ++hits;
                EXPECT_NEAR(solid->signed_distance(origin + direction * enter), 0, 1e-12);
                EXPECT_NEAR(solid->signed_distance(origin + direction * leave), 0, 1e-12);
                EXPECT_LE(solid->signed_distance(origin + direction * ((enter + leave) / 2)), 0);
            }
        }
        EXPECT_GT(hits, 30);
    }
    const auto cylinder = primitive_solid(Element::cylinder(1, 2));
    ASSERT_EQ(cylinder->inside_along({0.5, 0, -5}, {0, 0, 1}).size(), 1u);
    EXPECT_NEAR(cylinder->inside_along({0.5, 0, -5}, {0, 0, 1})[0].enter, 4, 1e-12);
    EXPECT_TRUE(cylinder->inside_along({1.5, 0, -5}, {0, 0, 1}).empty());
}

TEST(Primitives, Volumes) {
    constexpr double pi = std::numbers::pi;
    EXPECT_DOUBLE_EQ(primitive_solid(primitives[0])->volume(), 6);
    EXPECT_DOUBLE_EQ(primitive_solid(primitives[1])->volume(), 4 / 3.0 * pi * 0.343);
    EXPECT_DOUBLE_EQ(primitive_solid(primitives[2])->volume(), pi * 0.16 * 1.5);
    EXPECT_DOUBLE_EQ(primitive_solid(primitives[3])->volume(), pi * 0.16 * (1.5 + 4 / 3.0 * 0.4));
}
