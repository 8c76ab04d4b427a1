// The robots of others in FOAM_TEST_SHARED/robots.
#include "loading.hpp"
#include "support/shared_folder.hpp"

#include <cstdlib>
#include <fstream>
#include <iterator>

namespace foam::test {
namespace {

namespace fs = std::filesystem;

/// Counts as in the README of the robots.
struct Expected {
    const char* file;
    std::size_t links, joints, movable, meshes, spheres, cylinders, boxes, visuals;
};

void PrintTo(const Expected& value, std::ostream* stream) {
    *stream << value.file;
}

const Expected robots[] = {
    {"baxter/example-robot-data/robots/baxter_description/baxter_foam.urdf", 57, 56, 14, 8, 2, 24, 10, 38},
    {"baxter/example-robot-data/robots/baxter_description/urdf/baxter.urdf", 57, 56, 19, 2, 5, 24, 10, 38},
    {"fetch/fetch_description/fetch_foam.urdf", 21, 20, 8, 15, 0, 0, 0, 16},
    {"fetch/fetch_description/robots/fetch.urdf", 26, 25, 15, 21, 0, 0, 0, 21},
    {"iiwa/model.urdf", 8, 7, 7, 8, 0, 0, 0, 8},
    {"jaco/kinova_description/urdf/j2s7s300.urdf", 17, 16, 13, 14, 0, 0, 0, 21},
    {"panda/foam_variant/panda.urdf", 13, 12, 7, 11, 0, 0, 0, 11},
    {"panda/moveit_resources_panda_description/urdf/panda.urdf", 12, 11, 9, 11, 0, 0, 0, 11},
    {"stretch/RE1V0/stretch_description_RE1V0_tool_stretch_gripper.urdf", 44, 43, 12, 28, 1, 0, 1, 30},
    {"stretch/foam_variant/stretch/stretch.urdf", 43, 42, 12, 27, 1, 0, 1, 29},
    {"ur5/example-robot-data/robots/ur_description/urdf/ur5_robot.urdf", 11, 10, 6, 7, 0, 0, 1, 7},
};

class SharedRobot : public testing::TestWithParam<Expected> {
protected:
    static fs::path folder() { return shared_folder() / "robots"; }
};

std::size_t count(const Robot& robot, Element::Kind kind) {
    std::size_t result = 0;
    for (const Link& link : robot.links) {
        for (const GeometryElement& element : link.collisions) {
            const Element* primitive = std::get_if<Element>(&element.geometry);
            result += primitive && primitive->kind == kind;
        }
    }
    return result;
}

TEST_P(SharedRobot, LoadsWholeWithAndWithoutEnvironment) {
    const Expected& expected = GetParam();
    const fs::path file = folder() / expected.file;
    if (!fs::exists(file)) {
        GTEST_SKIP() << file << " is absent";
    }
    std::ifstream stream(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    const fs::path top = folder() / *fs::path(expected.file).begin();
    for (const ResourceResolver& resources : {ResourceResolver{}, ResourceResolver{{top}}}) {
        ListeningContext context;
        const Robot robot = load_text(text, context, file, resources);
        EXPECT_TRUE(context.messages.empty()) << context.messages.front();
        EXPECT_EQ(robot.source, text);
        EXPECT_EQ(robot.links.size(), expected.links);
        EXPECT_EQ(robot.joints.size(), expected.joints);
        EXPECT_EQ(count(robot, Element::Kind::sphere), expected.spheres);
        EXPECT_EQ(count(robot, Element::Kind::cylinder), expected.cylinders);
        EXPECT_EQ(count(robot, Element::Kind::box), expected.boxes);
        std::size_t meshes = 0, visuals = 0, movable = 0;
        for (const Link& link : robot.links) {
            visuals += link.visuals.size();
            for (const GeometryElement& element : link.collisions) {
                if (const MeshReference* mesh = std::get_if<MeshReference>(&element.geometry)) {
                    EXPECT_TRUE(fs::is_regular_file(mesh->path)) << mesh->uri;
                    ++meshes;
                }
            }
        }
        for (const Joint& joint : robot.joints) {
            movable += joint.kind != Joint::Kind::fixed;
        }
        EXPECT_EQ(meshes, expected.meshes);
        EXPECT_EQ(visuals, expected.visuals);
        EXPECT_EQ(movable, expected.movable);
        EXPECT_EQ(link_poses(robot).size(), expected.links);
    }
}

INSTANTIATE_TEST_SUITE_P(All, SharedRobot, testing::ValuesIn(robots), [](const auto& robot) {
    return fs::path(robot.param.file).stem().string() + "_" + std::to_string(robot.index);
});

} // namespace
} // namespace foam::test
