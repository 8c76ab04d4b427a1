// Meshes as plain data: what is checked, welded and counted.
#include <foam/base/error.hpp>
#include <foam/geometry/mesh.hpp>
#include <foam/geometry/mesh_checks.hpp>

#include <gmock/gmock.h>

#include <limits>

namespace foam {
namespace {

using ::testing::StrEq;

std::string refusal(const Mesh& mesh) {
    try {
        check_corners(mesh);
        return "";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::geometry);
        return error.what();
    }
}

TEST(CheckCorners, NamesTheFirstTriangleOrVertexThatIsNoUse) {
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    EXPECT_THAT(refusal({points, {{0, 1, 2}}}), StrEq(""));
    EXPECT_THAT(refusal({points, {{0, 1, 2}, {0, 3, 1}}}),
                StrEq("triangle 1 refers to vertex 3, but there are only 3"));
    EXPECT_THAT(refusal({{{0, 0, 0}, {1, 0, 0}, {0, nan, 0}}, {{0, 1, 2}}}),
                StrEq("vertex 2 of the mesh is not finite; remove its triangles or repair the file"));
    EXPECT_THAT(refusal({{{0, 0, 0}, {1, 0, -infinity}, {0, 1, 0}}, {{0, 1, 2}}}),
                StrEq("vertex 1 of the mesh is not finite; remove its triangles or repair the file"));
}

TEST(CheckCorners, AsksNothingOfUnusedVertices) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(refusal({{{nan, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{1, 2, 3}}}), StrEq(""));
}

TEST(Welded, JoinsEqualPositionsInTheOrderOfTheirFirstUse) {
    const Mesh mesh{{{9, 9, 9}, {0, 1, 0}, {1, 0, 0}, {0, 0, 0}, {-0.0, 0, 0}, {1, 0, 0}, {0, 0, 1}},
                    {{3, 2, 1}, {4, 6, 5}}};
    const Mesh expected{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}, {0, 3, 1}}};
    EXPECT_EQ(welded(mesh), expected);
}

TEST(Welded, DropsTrianglesThatLoseACornerAndTheirVertices) {
    const Mesh mesh{{{5, 0, 0}, {5, 0, 0}, {6, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {3, 4, 5}}};
    const Mesh expected{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    EXPECT_EQ(welded(mesh), expected);
}

TEST(Welded, HasNoNegativeZeros) {
    const Mesh result = welded({{{-0.0, 0, 0}, {1, -0.0, 0}, {0, 1, -0.0}}, {{0, 1, 2}}});
    for (const Vec3& p : result.vertices) {
        EXPECT_FALSE(std::signbit(p.x) || std::signbit(p.y) || std::signbit(p.z));
    }
}

TEST(SidesByEdge, PutsTheSidesOfAnEdgeTogether) {
    const std::vector<Triangle> triangles{{2, 1, 0}, {0, 0, 1}, {1, 2, 3}};
    std::vector<std::string> edges;
    for_each_edge(sides_by_edge(triangles, 4), [&](std::span<const Side> edge) {
        std::string text = std::to_string(edge[0].low) + std::to_string(edge[0].high) + ":";
        for (const Side& side : edge) {
            text += (side.forward ? " +" : " -") + std::to_string(side.number);
        }
        edges.push_back(text);
    });
    EXPECT_THAT(edges, ::testing::ElementsAre("01: -1 +4 -5", "02: +2", "12: -0 +6", "13: -8", "23: +7"));
}

TEST(SidesByEdge, LeavesOutTrianglesThatTakeNoPart) {
    const std::vector<Triangle> triangles{{0, 1, 2}, {0, 2, 3}};
    const std::vector<char> use{0, 1};
    const std::vector<Side> sides = sides_by_edge(triangles, 4, use);
    ASSERT_EQ(sides.size(), 3u);
    for (const Side& side : sides) {
        EXPECT_EQ(side.triangle(), 1u);
    }
}

} // namespace
} // namespace foam
