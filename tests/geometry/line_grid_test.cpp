// Where a grid's lines cross meshes: triangle by triangle as line by line.
#include "geometry/fine_shapes.hpp"
#include "geometry/src/mesh/line_grid.hpp"
#include "geometry/src/mesh/mesh_part.hpp"

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::geometry;
using namespace foam::test;

namespace {

/// Returns how many crossings there are.
std::size_t expect_as_line_by_line(const Mesh& mesh, const Box& box, std::size_t across = 20) {
    const MeshPart part(mesh, read_as_solid(mesh));
    std::size_t count = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const LineGrid grid(box, axis, across, "test");
        const GridCrossings crossings(part, grid);
        std::vector<Crossing> expected;
        for (std::size_t line = 0; line < grid.lines.size(); ++line) {
            part.crossings(grid.lines[line].origin(), grid.lines[line].direction(), expected);
            const auto found = crossings.of(line);
            EXPECT_EQ(found.size(), expected.size()) << "axis " << axis << ", line " << line;
            for (std::size_t i = 0; i < std::min(found.size(), expected.size()); ++i) {
                EXPECT_EQ(found[i].t, expected[i].t);
                EXPECT_EQ(found[i].change, expected[i].change);
            }
            count += expected.size();
        }
    }
    return count;
}

std::size_t expect_as_line_by_line(const Mesh& mesh) {
    return expect_as_line_by_line(mesh, Solid::make(mesh)->bounds());
}

Mesh moved(Mesh mesh, const Vec3& by) {
    for (Vec3& v : mesh.vertices) {
        v += by;
    }
    return mesh;
}

} // namespace

TEST(LineGrid, ClosedMeshes) {
    EXPECT_EQ(expect_as_line_by_line(box({0, 0, 0}, {1, 2, 3})), 3u * 20 * 20 * 2);
    EXPECT_GT(expect_as_line_by_line(torus(1, 0.3, 30)), 1000u);
    EXPECT_GT(expect_as_line_by_line(moved(torus(1, 0.3, 30), {0, 1e5, -1e4})), 1000u) << "rounded coordinates";
    EXPECT_GT(expect_as_line_by_line(moved(box({0, 0, 0}, {1, 1e-9, 1}), {3, 4, 5})), 1000u) << "thin";
}

TEST(LineGrid, LongThinTriangles) {
    Random random(1);
    Mesh mesh;
    for (std::uint32_t i = 0; i < 300; ++i) {
        const Vec3 a = random_point(random, {{0, 0, 0}, {1, 1, 1}}), b = random_point(random, {{0, 0, 0}, {1, 1, 1}});
        append(mesh, {{a, b, b + random_point(random, {{0, 0, 0}, {0.02, 0.02, 0.02}})}, {{0, 1, 2}}});
    }
    EXPECT_GT(expect_as_line_by_line(mesh), 1000u);
}

TEST(LineGrid, OpenMeshesWithWhatClosesThem) {
    Mesh bowl = ball({}, 1, 16);
    bowl.triangles.resize(bowl.triangles.size() * 2 / 3);
    EXPECT_GT(expect_as_line_by_line(bowl), 1000u);
}

TEST(LineGrid, LinesThroughEdgesAndVertices) {
    // All lines of a flat side of the box run within a plane, through vertices and along edges of the lattice.
    const Mesh lattice = box({0, 0, 0}, {1, 1, 1});
    EXPECT_GT(expect_as_line_by_line(lattice, {{0, 0, 0}, {1, 0, 1}}), 0u);
    EXPECT_GT(expect_as_line_by_line(together(lattice, ball({0.5, 0, 0.5}, 0.5, 8)), {{0, 0, 0.5}, {1, 0, 0.5}}), 0u);
    EXPECT_EQ(expect_as_line_by_line(lattice, {{2, 2, 2}, {3, 3, 3}}), 0u) << "beside it";
}

TEST(LineGrid, AnOpenMeshOfManyTriangles) {
    const Mesh bowl = fine_bowl();
    EXPECT_GT(expect_as_line_by_line(bowl, bounds(bowl), 12), 500u);
}
