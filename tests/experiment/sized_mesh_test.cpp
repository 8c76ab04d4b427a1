// Refinement keeps the surface; both ways end at the count.
#include "bench/src/sized_mesh.hpp"

#include <foam/robot/robot.hpp>
#include <foam/sdk/context.hpp>

#include <gtest/gtest.h>

namespace foam::experiment {
namespace {

Mesh cylinder() {
    return enclosing_mesh(Element::cylinder(0.1, 0.3));
}

TEST(Refined, KeepsTheSurfaceClosedAndWhereItIs) {
    const Mesh mesh = cylinder();
    for (const std::size_t count :
         {mesh.triangles.size() + 1, std::size_t{1000}, std::size_t{1001}, std::size_t{5000}}) {
        const Mesh fine = refined(mesh, count);
        EXPECT_GE(fine.triangles.size(), count);
        EXPECT_LE(fine.triangles.size(), count + 1);
        EXPECT_TRUE(topology(fine).closed_manifold());
        EXPECT_EQ(topology(fine).degenerate_triangles, 0U);
        EXPECT_NEAR(signed_volume(fine), signed_volume(mesh), 1e-12);
        EXPECT_NEAR(surface_area(fine), surface_area(mesh), 1e-12);
    }
}

TEST(Refined, SplitsTheLongestEdges) {
    const Mesh fine = refined(cylinder(), 20000);
    double longest = 0;
    for (const Triangle& t : fine.triangles) {
        for (int k = 0; k < 3; ++k) {
            longest = std::max(longest, norm(fine.vertices[t[k]] - fine.vertices[t[(k + 1) % 3]]));
        }
    }
    EXPECT_LT(longest, 0.02); // at first 0.3 m
}

TEST(Refined, NumbersNeighboursAlike) {
    const Mesh fine = refined(cylinder(), 20000);
    std::uint32_t used = 0; // vertices come in the order of their first use
    double farthest = 0, sum = 0;
    for (std::size_t t = 0; t < fine.triangles.size(); ++t) {
        for (const std::uint32_t corner : fine.triangles[t]) {
            EXPECT_LE(corner, used);
            used += corner == used ? 1 : 0;
        }
        const double step =
            norm(fine.vertices[fine.triangles[t][0]] - fine.vertices[fine.triangles[t > 0 ? t - 1 : 0][0]]);
        sum += step;
        farthest = std::max(farthest, step);
    }
    EXPECT_EQ(used, fine.vertices.size());
    EXPECT_LT(sum / static_cast<double>(fine.triangles.size()), 0.4 * farthest);
}

TEST(Refined, LeavesHolesAsTheyAre) {
    Mesh mesh = cylinder();
    mesh.triangles.pop_back();
    const Mesh fine = refined(mesh, 3000);
    EXPECT_GE(fine.triangles.size(), 3000U);
    EXPECT_TRUE(topology(fine).manifold());
    EXPECT_FALSE(topology(fine).closed());
    EXPECT_NEAR(surface_area(fine), surface_area(mesh), 1e-12);
}

TEST(Refined, LeavesWhatIsFineEnough) {
    EXPECT_EQ(refined(cylinder(), 10), cylinder());
}

TEST(Sized, GoesBothWays) {
    Registry registry;
    registry.load_directory(FOAM_TEST_PLUGINS);
    QuietContext context;
    const Mesh fine = sized(cylinder(), 4000, registry, context);
    EXPECT_EQ(fine.triangles.size(), 4000U);
    const Mesh coarse = sized(fine, 300, registry, context);
    EXPECT_LE(coarse.triangles.size(), 300U);
    EXPECT_GE(coarse.triangles.size(), 290U);
    EXPECT_TRUE(topology(coarse).closed_manifold());
}

} // namespace
} // namespace foam::experiment
