// Meshes as the page draws them: coarse ones, and vertices with normals and colours.
#include "chequered.hpp"
#include "drawn_mesh.hpp"

#include <gmock/gmock.h>

namespace foam::test {
namespace {

TEST(CoarseMesh, MergesVerticesAndKeepsColours) {
    const ViewedMesh fine = chequered(100), coarse = coarsened(fine, 0.1);
    ASSERT_EQ(coarse.colours.size(), coarse.mesh->triangles.size());
    EXPECT_LT(coarse.mesh->triangles.size(), 400u);
    EXPECT_GT(coarse.mesh->triangles.size(), 150u);
    EXPECT_NEAR(surface_area(*coarse.mesh), 1, 0.2);
    for (std::size_t t = 0; t < coarse.colours.size(); ++t) {
        const double x = coarse.mesh->vertices[coarse.mesh->triangles[t][0]].x;
        EXPECT_TRUE(coarse.colours[t] == 0xFF0000FFu ? x < 0.65 : x > 0.35) << x;
    }
    EXPECT_EQ(coarsened(fine, 1e-3).mesh->triangles, fine.mesh->triangles); // every vertex in a cell of its own
}

TEST(DrawnMesh, KeepsEdgesSharpAndRoundsSmoothSurfaces) {
    const auto count = [](const Element& primitive) {
        return drawn({std::make_shared<const Mesh>(enclosing_mesh(primitive)), {}}).vertices.size();
    };
    EXPECT_EQ(count(Element::box({1, 2, 3})), 24u); // each corner with three normals
    const Element ball = Element::sphere(1);
    EXPECT_EQ(count(ball), enclosing_mesh(ball).vertices.size());
}

TEST(DrawnMesh, SortsTrianglesByColourAndLeavesOutThoseWithoutArea) {
    Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}, {0, 0, 1}, {0, 1, 3}, {1, 2, 3}}};
    const DrawnMesh result = drawn({std::make_shared<const Mesh>(mesh), {0xFF0000FFu, 1, 0, 0xFF0000FFu}});
    ASSERT_EQ(result.ranges.size(), 2u);
    EXPECT_EQ(result.ranges[0].colour, std::nullopt);
    EXPECT_EQ(result.ranges[0].count, 3u);
    EXPECT_EQ(result.ranges[1].colour, 0xFF0000FFu);
    EXPECT_EQ(result.ranges[1].first, 3u);
    EXPECT_EQ(result.ranges[1].count, 6u);
    for (const std::uint32_t corner : result.corners) {
        EXPECT_LT(corner, result.vertices.size());
    }
}

} // namespace
} // namespace foam::test
