// The scene and the page that is one file.
#include "arm.hpp"

#include "drawn_mesh.hpp"

#include <foam/view/scene.hpp>

#include <nlohmann/json.hpp>

#include <cstring>

namespace foam::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Scene : public ArmTest {
protected:
    void read(const Subject& subject) {
        std::vector<SceneModel> models;
        for (const ViewedModel& model : subject.models) {
            models.push_back({.name = model.file.filename().string(),
                              .format = model.format,
                              .robot = model.robot,
                              .steps = {{model.spheres, {}, {}}},
                              .at = 0,
                              .ignored = {}});
        }
        page = static_page(subject, models);
        bytes = scene_bytes(subject, models, "null");
        json = head_of(bytes);
        arrays = (12 + length_of(bytes) + 7) / 8 * 8;
    }

    static std::uint32_t length_of(const std::string& bytes) {
        std::uint32_t length = 0;
        std::memcpy(&length, bytes.data() + 8, sizeof length);
        return length;
    }

    static nlohmann::json head_of(const std::string& bytes) {
        return nlohmann::json::parse(bytes.substr(12, length_of(bytes)));
    }

    static nlohmann::json fine_meshes(const Subject& subject) { return head_of(fine_mesh_bytes(subject))["meshes"]; }

    template <class T> std::vector<T> array(const nlohmann::json& place) const {
        std::vector<T> values(place["count"].get<std::size_t>());
        std::memcpy(values.data(), bytes.data() + arrays + place["at"].get<std::size_t>(), values.size() * sizeof(T));
        return values;
    }

    std::string bytes, page;
    nlohmann::json json;
    std::size_t arrays = 0;
};

TEST_F(Scene, HoldsRobotJointsAndSpheres) {
    read(subject(with({"arm.urdf", "arm.csv"})));
    EXPECT_EQ(bytes.substr(0, 8), "foamview");
    const auto& robot = json["robots"][0];
    EXPECT_EQ(robot["links"].size(), 4u);
    EXPECT_EQ(robot["links"][0]["visuals"][0]["colour"], "#ff8000ff");
    EXPECT_EQ(robot["freedoms"].size(), 2u);
    EXPECT_EQ(robot["joints"][2]["freedom"], 1); // it mimics
    EXPECT_EQ(robot["joints"][2]["axis"], (std::vector<double>{0, -1, 0}));
    const auto& elements = json["models"][0]["steps"][0]["elements"][0];
    EXPECT_EQ(elements["kind"], "sphere");
    EXPECT_EQ(array<std::uint32_t>(elements["starts"]), (std::vector<std::uint32_t>{0, 1, 2, 3, 4}));
    EXPECT_EQ(array<double>(elements["rows"])[7], 0.20801); // to the last digit
}

TEST_F(Scene, NamesAreTextThatCannotSteer) {
    std::string text = arm_urdf;
    for (std::size_t at = 0; (at = text.find("\"upper\"", at)) != text.npos; at += 1) {
        text.replace(at, 7, "\"&lt;/script&gt;&lt;script&gt;alert(1)&lt;/script&gt;&#x202E;&quot;'\"");
    }
    write("arm.urdf", text);
    read(subject(with({"arm.urdf"})));
    EXPECT_EQ(json["robots"][0]["links"][1]["name"], "</script><script>alert(1)</script>\\u{202e}\"'");
    EXPECT_THAT(page, Not(HasSubstr("alert(1)"))); // only within the bytes of the scene
    EXPECT_THAT(page, HasSubstr("script-src 'sha256-"));
    EXPECT_THAT(page, Not(HasSubstr("unsafe")));
}

/// A square of n x n x 2 triangles in the plane z = 0, the left half in one colour and the right in another.
ViewedMesh chequered(std::uint32_t n) {
    Mesh mesh;
    ViewedMesh result;
    for (std::uint32_t y = 0; y <= n; ++y) {
        for (std::uint32_t x = 0; x <= n; ++x) {
            mesh.vertices.push_back({x / double(n), y / double(n), 0});
        }
    }
    for (std::uint32_t y = 0; y < n; ++y) {
        for (std::uint32_t x = 0; x < n; ++x) {
            const std::uint32_t a = y * (n + 1) + x, b = a + n + 1;
            mesh.triangles.push_back({a, a + 1, b});
            mesh.triangles.push_back({a + 1, b + 1, b});
            result.colours.insert(result.colours.end(), 2, 2 * x < n ? 0xFF0000FFu : 0x0000FFFFu);
        }
    }
    result.mesh = std::make_shared<const Mesh>(std::move(mesh));
    return result;
}

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

TEST_F(Scene, HasCoarseMeshesFirstWhereThereAreManyTriangles) {
    Subject arm = subject(with({"arm.urdf", "arm.csv"}));
    for (const auto& mesh : fine_meshes(arm)) {
        EXPECT_TRUE(mesh.is_null());
    }
    arm.robots[0].links[0].visuals[0].mesh = std::make_shared<const ViewedMesh>(chequered(200)); // 80,000 triangles
    read(arm);
    EXPECT_LT(json["meshes"][0]["corners"]["count"], 3 * 40'000);
    EXPECT_EQ(json["meshes"][0]["box"][1], (std::vector<double>{1, 1, 0})); // of all vertices, not of their means
    const auto fine = fine_meshes(arm);
    ASSERT_EQ(fine.size(), json["meshes"].size());
    EXPECT_EQ(fine[0]["corners"]["count"], 3 * 80'000);
    for (std::size_t i = 1; i < fine.size(); ++i) {
        EXPECT_TRUE(fine[i].is_null()); // boxes
    }
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
