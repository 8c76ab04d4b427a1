// repair.wrap encloses anything.
#include "filters.hpp"

#include <foam/geometry/mesh_checks.hpp>
#include <foam/geometry/solid.hpp>

namespace foam::test {
namespace {

TEST(Wrap, EnclosesEveryDefect) {
    if (!registry().find("repair.wrap")) {
        GTEST_SKIP() << "built without GPL plugins";
    }
    for (const Named& shape : defective_meshes()) {
        SCOPED_TRACE(shape.name);
        const Mesh result = filtered("repair.wrap", shape.mesh, {{"alpha", 0.1}, {"offset", 0.01}});
        expect_solid(result);
        EXPECT_TRUE(self_intersections(result).empty());
        const auto solid = Solid::make(result);
        for (const Triangle& t : shape.mesh.triangles) {
            for (const std::uint32_t corner : t) {
                EXPECT_TRUE(solid->contains(shape.mesh.vertices[corner]));
            }
        }
    }
}

TEST(Wrap, RefusesTrianglesWithoutArea) {
    if (!registry().find("repair.wrap")) {
        GTEST_SKIP() << "built without GPL plugins";
    }
    const Vec3 along{0.04, 0, 0};
    Mesh line;
    line.vertices = {{}, along, -along, 2 * along};
    line.triangles = {{0, 1, 2}, {1, 2, 3}};
    EXPECT_EQ(refusal("repair.wrap", line),
              "the mesh has no triangle with an area: there is nothing to wrap");
}

} // namespace
} // namespace foam::test
