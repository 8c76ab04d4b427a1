// What a filter did: distances in both directions, volumes, defects.
#include "plain_shapes.hpp"

#include <foam/geometry/mesh_checks.hpp>

#include <gtest/gtest.h>

namespace foam::test {
namespace {

const Mesh cube = box({0, 0, 0}, {1, 1, 1});

TEST(MeshChange, EqualMeshesAreUnchanged) {
    const MeshChange change = mesh_change(cube, cube, 1);
    EXPECT_EQ(change.distance(), 0);
    EXPECT_EQ(change.volume_change(), 0.0);
    EXPECT_EQ(describe(change), "12 triangles, unchanged in place");
}

TEST(MeshChange, DistancesHaveADirection) {
    Mesh with_fin = cube;
    append(with_fin, box({0.4, 0.4, 1}, {0.6, 0.6, 1.5}));
    const MeshChange removed = mesh_change(with_fin, cube, 1);
    EXPECT_DOUBLE_EQ(removed.input_to_output.max, 0.5); // the fin is lost
    EXPECT_LT(removed.output_to_input.max, 1e-12);      // nothing was added
    EXPECT_GT(removed.input_to_output.mean, 0.001);
    const MeshChange added = mesh_change(cube, with_fin, 1);
    EXPECT_DOUBLE_EQ(added.output_to_input.max, 0.5);
    EXPECT_LT(added.input_to_output.max, 1e-12);
    EXPECT_DOUBLE_EQ(added.distance(), 0.5);
}

TEST(MeshChange, VolumeOfClosedMeshesOnly) {
    const MeshChange larger = mesh_change(cube, box({0, 0, 0}, {1, 1, 1.1}), 1);
    ASSERT_TRUE(larger.volume_change());
    EXPECT_NEAR(*larger.volume_change(), 0.1, 1e-12);
    EXPECT_EQ(describe(larger), "12 triangles, distance 100 mm, volume +10 %");

    Mesh open = cube;
    open.triangles.pop_back();
    const MeshChange closed = mesh_change(open, cube, 1);
    EXPECT_FALSE(closed.volume_before);
    EXPECT_NEAR(closed.volume_after.value(), 1, 1e-12);
    EXPECT_FALSE(closed.volume_change());
    EXPECT_EQ(closed.before.boundary_edges, 3u);
    EXPECT_TRUE(closed.after.closed_manifold());
    EXPECT_NE(describe(closed).find("; was: 3 boundary edges"), std::string::npos) << describe(closed);
}

TEST(MeshChange, WeldingAloneIsNoChangeOfShape) {
    Mesh loose;
    for (const Triangle& t : cube.triangles) {
        for (const std::uint32_t corner : t) {
            loose.vertices.push_back(cube.vertices[corner]);
        }
        const auto n = static_cast<std::uint32_t>(loose.vertices.size());
        loose.triangles.push_back({n - 3, n - 2, n - 1});
    }
    const MeshChange change = mesh_change(loose, welded(loose), 1);
    EXPECT_EQ(change.distance(), 0);
    EXPECT_TRUE(change.before.closed_manifold());
}

TEST(MeshChange, SameNumbersAgain) {
    const Mesh coarse = ball({}, 0.1, 8), fine = ball({}, 0.1, 24);
    const MeshChange first = mesh_change(fine, coarse, 7), second = mesh_change(fine, coarse, 7);
    EXPECT_EQ(first.input_to_output, second.input_to_output);
    EXPECT_EQ(first.output_to_input, second.output_to_input);
    // The sagitta of the coarse ball's chords: 0.1 (1 - cos(π/16)) and, across both directions, about twice that.
    EXPECT_GT(first.input_to_output.max, 0.1 * (1 - std::cos(std::numbers::pi / 16)));
    EXPECT_LT(first.input_to_output.max, 0.1 * 2.5 * (1 - std::cos(std::numbers::pi / 16)));
}

TEST(LiesWithin, ProvesDistances) {
    const Mesh coarse = ball({}, 0.1, 8), fine = ball({}, 0.1, 32);
    const double sagitta = mesh_change(fine, coarse, 1, 20'000).input_to_output.max;
    EXPECT_TRUE(lies_within(1.01 * sagitta, fine, coarse));
    EXPECT_FALSE(lies_within(0.9 * sagitta, fine, coarse));
    EXPECT_TRUE(lies_within(1e-12, cube, cube));
    EXPECT_TRUE(lies_within(0.1 + 1e-12, cube, box({0, 0, 0}, {1, 1, 1.1})));
    EXPECT_FALSE(lies_within(0.0999, cube, box({0, 0, 0}, {1, 1, 1.1})));
}

TEST(LiesWithin, SeesAThornBetweenTheVertices) {
    // Every corner of the large triangle is on the other surface, its middle is not.
    const Mesh large{{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}}, {{0, 1, 2}}};
    const Mesh holed{{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {1, 1, -0.5}}, {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
    EXPECT_FALSE(lies_within(0.2, large, holed));
    EXPECT_TRUE(lies_within(0.5, large, holed));
}

} // namespace
} // namespace foam::test
