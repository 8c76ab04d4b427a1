// repair.soup and repair.auto: repaired in place where that is enough, rebuilt where it is not.
#include "filters.hpp"

#include <foam/geometry/mesh_checks.hpp>

#include <gmock/gmock.h>

#include <numbers>

namespace foam::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const Mesh& defective(const std::string& name) {
    static const std::vector<Named> shapes = defective_meshes();
    return std::find_if(shapes.begin(), shapes.end(), [&](const Named& s) { return s.name == name; })->mesh;
}

struct Outcome {
    Mesh mesh;
    std::string said;
};

Outcome outcome(const std::string& stage, const Mesh& mesh, const Settings& settings = {}) {
    Listener listener;
    Mesh result = filter(stage, settings)->apply(mesh, listener);
    expect_solid(result);
    return {std::move(result), listener.said};
}

TEST(Soup, MendsInPlace) {
    struct Case {
        const char* defect;
        double volume;
        const char* said;
    };
    const double ball_volume = signed_volume(ball({}, 0.1)), torus_volume = signed_volume(torus(0.2, 0.06));
    for (const Case& expected :
         {Case{"open box", 1, "1 holes filled"}, Case{"T junction", 1, "1 T-junctions joined"},
          Case{"shared edge", 2, "vertices added where parts touch"}, Case{"shared corner", 2, ""},
          Case{"shared face", 2, "taken out"}, Case{"double sided", 1, "repeat others"},
          Case{"no area", 1, "have no area"}, Case{"inside out", ball_volume, "faced the wrong way"},
          Case{"mixed winding", torus_volume, "facing either way"}}) {
        SCOPED_TRACE(expected.defect);
        const Outcome result = outcome("repair.soup", defective(expected.defect));
        EXPECT_NEAR(signed_volume(result.mesh), expected.volume, 1e-12);
        EXPECT_THAT(result.said, HasSubstr(expected.said));
    }
}

TEST(Soup, KeepsWhatIsSound) {
    for (const Named& shape : sound_meshes()) {
        SCOPED_TRACE(shape.name);
        EXPECT_EQ(outcome("repair.soup", shape.mesh).mesh, welded(shape.mesh));
        EXPECT_EQ(outcome("repair.auto", shape.mesh).mesh, welded(shape.mesh));
    }
}

TEST(Soup, FillsFlatHolesOfAnySizeAndOthersUpToALimit) {
    const Mesh cylinder = open_cylinder(0.1, 0.3);
    const double full = signed_volume(outcome("repair.soup", cylinder).mesh);
    EXPECT_NEAR(full, std::numbers::pi * 0.01 * 0.3, 0.01 * std::numbers::pi * 0.01 * 0.3);
    const Mesh bitten = without(ball({}, 0.1), 100, 12); // a hole that is not flat
    EXPECT_THAT(refusal("repair.soup", bitten, {{"largest_hole", 0.01}}),
                HasSubstr("too broken to be repaired in place"));
    const double whole = signed_volume(ball({}, 0.1));
    EXPECT_NEAR(signed_volume(outcome("repair.soup", bitten, {{"largest_hole", 1.0}}).mesh), whole, 0.02 * whole);
}

TEST(Soup, FillsAConcaveHoleAlongItsPlane) {
    // An L without its lid: the lid is concave, and the least area is that of the L.
    const std::vector<Vec3> outline{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
    Mesh mesh;
    for (const double z : {0.0, 1.0}) {
        for (const Vec3& p : outline) {
            mesh.vertices.push_back({p.x, p.y, z});
        }
    }
    for (std::uint32_t i = 0; i < 6; ++i) {
        const std::uint32_t k = (i + 1) % 6;
        mesh.triangles.push_back({i, k, k + 6});
        mesh.triangles.push_back({i, k + 6, i + 6});
    }
    const Outcome result = outcome("repair.soup", mesh);
    EXPECT_NEAR(signed_volume(result.mesh), 3, 1e-12);
    EXPECT_NEAR(surface_area(result.mesh), 8 + 2 * 3, 1e-12);
    EXPECT_THAT(result.said, HasSubstr("2 holes filled"));
}

/// A cube of side 2, and a pipe of square section that stands in it, open at the bottom, and comes out by 0.5; its
/// largest triangles are inside of the cube.
Mesh pipe_in_a_cube() {
    Mesh pipe;
    for (const double z : {-0.9, 0.9, 1.5}) {
        for (const Vec3& corner : {Vec3{-0.5, -0.5, z}, {0.5, -0.5, z}, {0.5, 0.5, z}, {-0.5, 0.5, z}}) {
            pipe.vertices.push_back(corner);
        }
    }
    for (std::uint32_t ring : {0u, 4u}) {
        for (std::uint32_t k = 0; k < 4; ++k) {
            const std::uint32_t a = ring + k, b = ring + (k + 1) % 4;
            pipe.triangles.push_back({a, b, b + 4});
            pipe.triangles.push_back({a, b + 4, a + 4});
        }
    }
    pipe.triangles.push_back({8, 9, 10});
    pipe.triangles.push_back({8, 10, 11});
    return united(box({}, {2, 2, 2}), pipe);
}

TEST(Soup, KeepsABodyThatComesOutOfAnother) {
    for (const char* repair : {"repair.soup", "repair.auto"}) {
        SCOPED_TRACE(repair);
        const Outcome result = outcome(repair, pipe_in_a_cube());
        EXPECT_NEAR(bounds(result.mesh).high.z, 1.5, 1e-9);
        EXPECT_NEAR(signed_volume(result.mesh), 8 + 2.4, 1e-9); // the cube and the whole pipe: they overlap
        EXPECT_THAT(result.said, Not(HasSubstr("taken out")));
    }
}

TEST(Soup, RefusesWhatHasNoInside) {
    for (const char* name : {"flat", "single triangle", "needle", "soup"}) {
        SCOPED_TRACE(name);
        EXPECT_THAT(refusal("repair.soup", defective(name)), HasSubstr("remedy: repair.auto"));
    }
}

TEST(Auto, TakesTheLightestRepair) {
    EXPECT_THAT(outcome("repair.auto", ball({}, 0.1)).said, HasSubstr("taken: repair.soup"));
    EXPECT_THAT(outcome("repair.auto", defective("T junction")).said, HasSubstr("taken: repair.soup"));
    EXPECT_THAT(outcome("repair.auto", defective("soup")).said,
                HasSubstr("taken: repair.watertight with 1000 leaves; mending in place was not enough"));
}

TEST(Auto, MakesEveryDefectASolidThatDoesNotPassThroughItself) {
    for (const Named& shape : defective_meshes()) {
        SCOPED_TRACE(shape.name);
        const Outcome result = outcome("repair.auto", shape.mesh);
        const MeshChange change = mesh_change(shape.mesh, result.mesh, 1);
        if (shape.name != "shared face") { // its wall, inside, is taken out
            EXPECT_LT(change.input_to_output.max, 0.02 * bounds(shape.mesh).diagonal());
        }
        if (result.said.find("repair.watertight") != std::string::npos) {
            EXPECT_TRUE(self_intersections(result.mesh).empty());
        }
    }
}

TEST(Auto, SameShapeWhereverItIsAndInWhateverOrder) {
    for (const char* name : {"T junction", "shared face", "ball with a hole", "soup"}) {
        SCOPED_TRACE(name);
        const Mesh& mesh = defective(name);
        const double volume = signed_volume(outcome("repair.auto", mesh).mesh);
        Mesh again = mesh; // every face twice, in reverse
        again.triangles.insert(again.triangles.end(), mesh.triangles.rbegin(), mesh.triangles.rend());
        std::reverse(again.triangles.begin(), again.triangles.end());
        EXPECT_NEAR(signed_volume(outcome("repair.auto", again).mesh), volume, 0.02 * volume);
        for (const double scale : {1e-6, 1e4}) {
            const Mesh other = scaled(mesh, scale, Vec3{3, -2, 1} * scale);
            const double expected = volume * scale * scale * scale;
            EXPECT_NEAR(signed_volume(outcome("repair.auto", other).mesh), expected, 0.02 * expected);
        }
    }
}

} // namespace
} // namespace foam::test
