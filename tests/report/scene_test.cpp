// What the viewer draws: meshes on a grid, spheres as floats.
#include "fixture.hpp"

#include <foam/report/internal/report.hpp>

namespace foam::test {
namespace {

using namespace report;

Mesh ball(int segments) {
    return enclosing_mesh(Element::sphere(0.3), segments);
}

SceneLink link_of(const std::string& name, Mesh mesh) {
    return {.name = name,
            .pose = {},
            .meshes = {{"original", std::make_shared<const Mesh>(std::move(mesh))}},
            .levels = {{{{0, 0, 0}, 1}}}};
}

std::size_t triangles_of(const nlohmann::json& mesh) {
    return (mesh["wide"].get<bool>() ? values<std::uint32_t>(mesh["triangles"]).size()
                                     : values<std::uint16_t>(mesh["triangles"]).size()) /
           3;
}

TEST(Scene, CornersMoveByHalfAStepAtMost) {
    const Mesh mesh = ball(24);
    const Vec3 size = bounds(mesh).size();
    const GridMesh grid = on_grid(mesh, 16);
    EXPECT_EQ(grid.corners.size(), welded(mesh).vertices.size());
    EXPECT_EQ(grid.triangles.size(), mesh.triangles.size());
    EXPECT_NEAR(grid.step, std::max({size.x, size.y, size.z}) / 65535, 1e-9);
    for (const auto& corner : grid.corners) {
        const Vec3 place = grid.low + Vec3{double(corner[0]), double(corner[1]), double(corner[2])} * grid.step;
        double nearest = 1;
        for (const Vec3& vertex : mesh.vertices) {
            const Vec3 d = place - vertex;
            nearest = std::min(nearest, std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}));
        }
        EXPECT_LE(nearest, 0.5001 * grid.step);
    }
}

TEST(Scene, ACoarseGridHasFewerTriangles) {
    const Mesh mesh = ball(96);
    EXPECT_LT(on_grid(mesh, 4).triangles.size(), mesh.triangles.size() / 3);
    EXPECT_GT(on_grid(mesh, 4).triangles.size(), 100u);
}

TEST(Scene, AMeshWithoutExtentIsNothingToDraw) {
    const GridMesh grid = on_grid({{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {{0, 1, 2}}}, 16);
    EXPECT_EQ(grid.corners.size(), 1u);
    EXPECT_TRUE(grid.triangles.empty());
    EXPECT_TRUE(on_grid({}, 16).corners.empty());
}

TEST(Scene, OnlyWhatExceedsItsShareIsDrawnCoarser) {
    const Mesh small = ball(6), large = ball(120);
    const auto scene = nlohmann::json::parse(scene_json({link_of("small", small), link_of("large", large)}, 4000));
    ASSERT_EQ(scene["meshes"].size(), 2u);
    EXPECT_EQ(triangles_of(scene["meshes"][0]), small.triangles.size());
    EXPECT_LE(triangles_of(scene["meshes"][1]), 4000 - small.triangles.size());
    EXPECT_GT(triangles_of(scene["meshes"][1]), 700u);
    EXPECT_LT(scene["drawn"].get<double>(), 1);
    EXPECT_EQ(nlohmann::json::parse(scene_json({link_of("small", small)}, 4000))["drawn"], 1.0);
}

TEST(Scene, EqualMeshesAreThereOnce) {
    const auto scene =
        nlohmann::json::parse(scene_json({link_of("left", ball(8)), link_of("right", ball(8))}, 100'000));
    EXPECT_EQ(scene["meshes"].size(), 1u);
    EXPECT_EQ(scene["links"][1]["meshes"], nlohmann::json({0}));
}

TEST(Scene, MoreCornersThanSixteenBitsCount) {
    const Mesh mesh = ball(400);
    const auto scene = nlohmann::json::parse(scene_json({link_of("large", mesh)}, 1'000'000));
    EXPECT_TRUE(scene["meshes"][0]["wide"]);
    const auto corners = values<std::uint16_t>(scene["meshes"][0]["corners"]).size() / 3;
    EXPECT_GT(corners, 65535u);
    for (const std::uint32_t corner : values<std::uint32_t>(scene["meshes"][0]["triangles"])) {
        ASSERT_LT(corner, corners);
    }
}

TEST(Scene, NoNameEndsTheScript) {
    const std::string json = scene_json({link_of("</script><!--\xff", ball(6))}, 1000);
    EXPECT_EQ(json.find('<'), json.npos);
    EXPECT_EQ(nlohmann::json::parse(json)["links"][0]["name"], "</script><!--\\xff");
}

} // namespace
} // namespace foam::test
