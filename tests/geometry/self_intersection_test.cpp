// Triangles that pass through each other, and triangles that only touch.
#include "shapes.hpp"

#include <foam/geometry/mesh_checks.hpp>

#include <gtest/gtest.h>

namespace foam::test {
namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

TEST(SelfIntersection, ClosedSurfacesHaveNone) {
    EXPECT_TRUE(self_intersections(box({0, 0, 0}, {1, 2, 3})).empty());
    EXPECT_TRUE(self_intersections(ball({1, 2, 3}, 0.1)).empty());
    EXPECT_TRUE(self_intersections(torus(0.3, 0.1)).empty());
}

TEST(SelfIntersection, TouchingIsNoPassingThrough) {
    for (const Vec3& shift : {Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{1, 1, 1}, Vec3{1, 0.5, 0.25}}) {
        Mesh two = box({0, 0, 0}, {1, 1, 1});
        append(two, box(shift, shift + Vec3{1, 1, 1}));
        EXPECT_TRUE(self_intersections(two).empty());
    }
}

TEST(SelfIntersection, FindsBodiesThatOverlap) {
    Mesh two = box({0, 0, 0}, {1, 1, 1});
    append(two, box({0.5, 0.4, 0.3}, {1.7, 1.6, 1.5}));
    const Pairs pairs = self_intersections(two);
    EXPECT_FALSE(pairs.empty());
    EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
    for (const auto& [a, b] : pairs) { // only faces of different boxes
        EXPECT_LT(a, 12u);
        EXPECT_GE(b, 12u);
    }
}

TEST(SelfIntersection, FindsASinglePairAtAnyScale) {
    for (const double scale : {1e-6, 1.0, 1e6}) {
        Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, -0.5}, {0.3, 0.2, 0.5}, {5, 5, 0.5}},
                  {{0, 1, 2}, {3, 4, 5}}};
        for (Vec3& v : mesh.vertices) {
            v = v * scale;
        }
        EXPECT_EQ(self_intersections(mesh), (Pairs{{0, 1}}));
    }
}

TEST(SelfIntersection, NeighboursMayPassThroughEachOtherToo) {
    // Two triangles share vertex 0; the opposite side of the second goes through the first.
    const Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 0.5}, {0.3, 0.3, -0.5}}, {{0, 1, 2}, {0, 3, 4}}};
    EXPECT_EQ(self_intersections(mesh), (Pairs{{0, 1}}));
}

} // namespace
} // namespace foam::test
