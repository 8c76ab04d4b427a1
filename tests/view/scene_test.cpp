// The scene and the page that is one file.
#include "arm.hpp"
#include "chequered.hpp"

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

} // namespace
} // namespace foam::test
