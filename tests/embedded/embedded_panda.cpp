// The robot that a fresh clone runs on: its kinematics are the published ones, its meshes have the overall sizes and
// the flaws that its README states.
#include <foam/sdk/registry.hpp>

#include <gtest/gtest.h>

#include <numbers>

namespace foam {
namespace {

const std::filesystem::path folder = FOAM_TEST_SOURCE "/configs/robots/panda";

class EmbeddedPanda : public testing::Test {
protected:
    void SetUp() override {
        for (const char* plugin : {"/load_urdf.so", "/load_mjcf.so", "/load_mesh.so"}) {
            const PluginRecord& record = registry.load(std::string(FOAM_TEST_PLUGINS) + plugin);
            ASSERT_TRUE(record.loaded()) << record.rejection;
        }
        const auto file = folder / "panda.urdf";
        robot = registry.make<RobotLoader>("load.urdf")->load(read(file), file, ResourceResolver{}, context);
    }

    static std::string read(const std::filesystem::path& file) {
        std::FILE* stream = std::fopen(file.c_str(), "rb");
        EXPECT_NE(stream, nullptr) << file;
        std::string text(std::filesystem::file_size(file), '\0');
        EXPECT_EQ(std::fread(text.data(), 1, text.size(), stream), text.size());
        std::fclose(stream);
        return text;
    }

    Mesh mesh(const std::string& name) {
        return registry.make<MeshLoader>("load.mesh")->load(folder / "meshes" / name, context);
    }

    Registry registry;
    QuietContext context;
    Robot robot;
};

TEST_F(EmbeddedPanda, HasTheUsualLinksAndOneMeshEach) {
    std::vector<std::string> with_geometry;
    for (const Link& link : robot.links) {
        if (!link.collisions.empty()) {
            ASSERT_EQ(link.collisions.size(), 1U) << link.name;
            ASSERT_TRUE(std::holds_alternative<MeshReference>(link.collisions[0].geometry)) << link.name;
            with_geometry.push_back(link.name);
        }
    }
    EXPECT_EQ(with_geometry, (std::vector<std::string>{"panda_link0", "panda_link1", "panda_link2", "panda_link3",
                                                       "panda_link4", "panda_link5", "panda_link6", "panda_link7",
                                                       "panda_hand", "panda_leftfinger", "panda_rightfinger"}));
    EXPECT_EQ(robot.links.size(), 12U);
    EXPECT_EQ(robot.root, "panda_link0");
    EXPECT_NE(robot.find_link("panda_link8"), nullptr);
}

TEST_F(EmbeddedPanda, JointLimitsAreThePublishedOnes) {
    const std::map<std::string, std::pair<double, double>> published{
        {"panda_joint1", {-2.8973, 2.8973}},  {"panda_joint2", {-1.7628, 1.7628}}, {"panda_joint3", {-2.8973, 2.8973}},
        {"panda_joint4", {-3.0718, -0.0698}}, {"panda_joint5", {-2.8973, 2.8973}}, {"panda_joint6", {-0.0175, 3.7525}},
        {"panda_joint7", {-2.8973, 2.8973}},  {"panda_finger_joint1", {0, 0.04}},  {"panda_finger_joint2", {0, 0.04}}};
    std::size_t checked = 0;
    for (const Joint& joint : robot.joints) {
        if (const auto limits = published.find(joint.name); limits != published.end()) {
            EXPECT_EQ(joint.lower, limits->second.first) << joint.name;
            EXPECT_EQ(joint.upper, limits->second.second) << joint.name;
            ++checked;
        } else {
            EXPECT_EQ(joint.kind, Joint::Kind::fixed) << joint.name;
        }
    }
    EXPECT_EQ(checked, published.size());
}

TEST_F(EmbeddedPanda, TheMjcfIsTheSameArm) {
    const auto file = folder / "panda.xml";
    const Robot twin = registry.make<RobotLoader>("load.mjcf")->load(read(file), file, ResourceResolver{}, context);
    const JointValues values{{"panda_joint1", 0.3}, {"panda_joint2", -0.4}, {"panda_joint3", 0.5},
                             {"panda_joint4", -1.6}, {"panda_joint5", 0.7}, {"panda_joint6", 1.8},
                             {"panda_joint7", -0.9}, {"panda_finger_joint1", 0.01}, {"panda_finger_joint2", 0.02}};
    JointValues of_urdf = values;
    of_urdf["panda_finger_joint2"] = 0.01; // follows the other
    const auto here = link_poses(robot, of_urdf), there = link_poses(twin, values);
    std::size_t compared = 0;
    for (const Link& link : robot.links) {
        const Link* other = twin.find_link(link.name);
        if (!other || link.name == "panda_rightfinger") {
            continue;
        }
        EXPECT_EQ(link.collisions.size(), other->collisions.size()) << link.name;
        const Pose &a = here.at(link.name), &b = there.at(link.name);
        EXPECT_LT(norm(a.translation - b.translation), 1e-9) << link.name;
        EXPECT_LT(norm(a.rotate({1, 2, 3}) - b.rotate({1, 2, 3})), 1e-9) << link.name;
        ++compared;
    }
    EXPECT_EQ(compared, 10U) << "all but the frame of the flange and the finger that follows";
}

// The flange in two poses, worked out by hand from Franka's Denavit-Hartenberg parameters.
TEST_F(EmbeddedPanda, FlangeStandsWhereTheKinematicsPutIt) {
    constexpr double right = std::numbers::pi / 2;
    // Elbow bent by a right angle, forearm level; the hand points down.
    JointValues ready{{"panda_joint4", -right}, {"panda_joint6", right}};
    const Vec3 level = link_poses(robot, ready).at("panda_link8").translation;
    EXPECT_NEAR(level[0], 0.0825 + 0.384 + 0.088, 1e-9);
    EXPECT_NEAR(level[1], 0, 1e-9);
    EXPECT_NEAR(level[2], 0.333 + 0.316 + 0.0825 - 0.107, 1e-9);
    // The same turned by a right angle about the vertical.
    ready["panda_joint1"] = right;
    const Vec3 turned = link_poses(robot, ready).at("panda_link8").translation;
    EXPECT_NEAR(turned[0], 0, 1e-9);
    EXPECT_NEAR(turned[1], level[0], 1e-9);
    EXPECT_NEAR(turned[2], level[2], 1e-9);
}

struct Expected {
    const char* file;
    std::size_t triangles;
    std::size_t open_edges; ///< after welding
    Vec3 low, high;         ///< overall size of the real link, m
};

const std::vector<Expected> meshes{
    {"link0.stl", 1720, 0, {-0.154, -0.095, 0.0}, {0.072, 0.095, 0.140}},
    {"link1.stl", 1496, 0, {-0.055, -0.129, -0.192}, {0.055, 0.055, 0.055}},
    {"link2.obj", 1528, 80, {-0.055, -0.194, -0.055}, {0.055, 0.055, 0.129}},
    {"link3.dae", 1624, 0, {-0.055, -0.055, -0.121}, {0.137, 0.111, 0.055}},
    {"link4.stl", 1412, 46, {-0.137, -0.055, -0.055}, {0.055, 0.124, 0.111}},
    {"link5.obj", 1616, 40, {-0.055, -0.055, -0.264}, {0.055, 0.130, 0.052}},
    {"link6.dae", 1512, 40, {-0.048, -0.051, -0.044}, {0.132, 0.082, 0.056}},
    {"link7.stl", 1544, 0, {-0.044, -0.044, 0.052}, {0.081, 0.081, 0.107}},
    {"hand.obj", 1308, 0, {-0.032, -0.103, -0.026}, {0.032, 0.100, 0.066}},
    {"finger.stl", 216, 0, {-0.0105, 0.0, 0.0}, {0.0105, 0.027, 0.054}},
};

TEST_F(EmbeddedPanda, MeshesHaveTheOverallSizesOfTheArm) {
    for (const Expected& expected : meshes) {
        const Box box = bounds(mesh(expected.file));
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(box.low[axis], expected.low[axis], 0.0025) << expected.file << " axis " << axis;
            EXPECT_NEAR(box.high[axis], expected.high[axis], 0.0025) << expected.file << " axis " << axis;
        }
    }
}

TEST_F(EmbeddedPanda, MeshesHaveTheFlawsThatTheReadmeStates) {
    for (const Expected& expected : meshes) {
        const Mesh welded_mesh = welded(mesh(expected.file));
        const Topology found = topology(welded_mesh);
        EXPECT_EQ(welded_mesh.triangles.size(), expected.triangles) << expected.file;
        EXPECT_EQ(found.boundary_edges, expected.open_edges) << expected.file;
        EXPECT_EQ(found.nonmanifold_edges, 0U) << expected.file;
        EXPECT_EQ(found.misoriented_edges, 0U) << expected.file;
        EXPECT_EQ(found.degenerate_triangles, 0U) << expected.file;
        EXPECT_GE(found.components, 4U) << expected.file << ": an assembly of overlapping bodies";
        EXPECT_GT(signed_volume(welded_mesh), 0) << expected.file;
    }
}

TEST_F(EmbeddedPanda, ReadmeStatesTheTriangles) {
    const std::string readme = read(folder / "README.md");
    for (const Expected& expected : meshes) {
        const auto row = readme.find("| `" + std::string(expected.file) + "` |");
        ASSERT_NE(row, std::string::npos) << expected.file;
        const std::string line = readme.substr(row, readme.find('\n', row) - row);
        std::string count = "| ";
        count.append(std::to_string(expected.triangles)).append(" |");
        EXPECT_NE(line.find(count), std::string::npos) << line;
    }
}

TEST_F(EmbeddedPanda, FilesAreSmall) {
    std::uintmax_t bytes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "meshes")) {
        bytes += entry.file_size();
    }
    EXPECT_LT(bytes, 600'000U);
}

// A mesh that is turned by half a turn: both fingers close on the plane y = 0 of the hand.
TEST_F(EmbeddedPanda, FingersMirrorEachOther) {
    const auto poses = link_poses(robot);
    const auto placed = [&](const char* name) {
        const GeometryElement& element = robot.find_link(name)->collisions[0];
        return bounds(
            transformed(mesh("finger.stl"), poses.at("panda_hand").inverse() * poses.at(name) * element.origin));
    };
    const Box left = placed("panda_leftfinger"), right = placed("panda_rightfinger");
    EXPECT_NEAR(left.low[1], 0, 1e-9);
    EXPECT_NEAR(right.high[1], 0, 1e-9);
    EXPECT_NEAR(left.high[1], -right.low[1], 1e-9);
    EXPECT_NEAR(left.high[2], right.high[2], 1e-9);
    EXPECT_GT(left.low[2], 0.058);
}

} // namespace
} // namespace foam
