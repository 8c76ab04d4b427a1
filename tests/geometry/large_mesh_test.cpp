// Meshes of so many triangles that they are shared instead of copied, with hierarchies that are quick to build.
#include "geometry/fine_shapes.hpp"

#include <foam/geometry/internal/surface_runs.hpp>

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::geometry;
using namespace foam::test;

TEST(LargeMesh, IsTheSurfaceItselfAsLongAsNothingIsTurned) {
    const auto mesh = std::make_shared<const Mesh>(ball({}, 1, 12));
    EXPECT_EQ(&Solid::make(std::vector<Solid::Part>{{mesh, {}, {}}})->surface(), mesh.get());
    const auto inside_out = std::make_shared<const Mesh>(flipped(*mesh));
    const auto turned = Solid::make(std::vector<Solid::Part>{{inside_out, {}, {}}});
    EXPECT_NE(&turned->surface(), inside_out.get());
    EXPECT_GT(signed_volume(turned->surface()), 0);
    const auto empty = std::make_shared<const Mesh>();
    const auto both = Solid::make(std::vector<Solid::Part>{{empty, {}, {}}, {mesh, {}, {}}, {inside_out, {}, {}}});
    ASSERT_EQ(both->surface().triangles.size(), 2 * mesh->triangles.size());
    EXPECT_EQ(mesh->triangles.size(), ball({}, 1, 12).triangles.size()) << "a shared mesh is not appended to";
    EXPECT_NEAR(signed_volume(both->surface()), 2 * signed_volume(*mesh), 1e-12);
}

TEST(LargeMesh, QueriesAreThoseOfAFewTriangles) {
    Random random(1);
    for (const Mesh& mesh : {fine_ball(), fine_bowl()}) {
        const auto solid = Solid::make(mesh);
        for (int i = 0; i < 200; ++i) {
            const Vec3 p = random_point(random, {{-1.5, -1.5, -1.5}, {1.5, 1.5, 0.5}});
            const double off = norm(p) - 1;
            if (std::abs(off) < 1e-3) {
                continue;
            }
            EXPECT_NEAR(solid->signed_distance(p), off, 1e-3) << p.x << " " << p.y << " " << p.z;
            EXPECT_EQ(solid->contains(p), off < 0);
            const SurfacePoint nearest = solid->closest(p);
            const auto& [a, b, c] = solid->surface().triangles[nearest.triangle];
            const std::vector<Vec3>& vertices = solid->surface().vertices;
            const Vec3 middle = (vertices[a] + vertices[b] + vertices[c]) / 3;
            EXPECT_LT(distance(nearest.point, middle), 0.05);
        }
    }
    EXPECT_NEAR(Solid::make(fine_ball())->volume(), signed_volume(fine_ball()), 1e-9);
}

TEST(LargeMesh, GroupsOfRunsContainTheirTriangles) {
    const auto solid = Solid::make(ball({5, 0, 0}, 1, 60));
    const SurfaceRuns& runs = surface_runs(*solid);
    ASSERT_EQ(runs.group_count(), (runs.size() + SurfaceRuns::group_length - 1) / SurfaceRuns::group_length);
    const Vec3 origin = solid->bounds().center();
    for (std::size_t r = 0; r < runs.size(); ++r) {
        const SurfaceRuns::Run& group = runs.group(r / SurfaceRuns::group_length);
        for (const std::uint32_t t : runs.triangles(r)) {
            for (const std::uint32_t corner : solid->surface().triangles[t]) {
                EXPECT_LE(distance(solid->surface().vertices[corner] - origin, group.center),
                          group.radius * (1 + 1e-12));
            }
        }
    }
}

TEST(LargeMesh, ProofFindsTheOneTriangleThatNoBallContains) {
    Mesh mesh = fine_ball();
    const std::vector<Sphere> around{{{0, 0, 0.2}, 1.21}, {{0, 0, -0.2}, 1.21}};
    EXPECT_TRUE(certify(*Solid::make(mesh), around).holds);
    const Vec3 out{0, 0, 1.5};
    mesh.vertices[mesh.triangles[77'777][0]] = out;
    const Certificate certificate = certify(*Solid::make(mesh), around);
    EXPECT_FALSE(certificate.holds);
    EXPECT_NEAR(certificate.growth, 0.09, 0.01);
}
