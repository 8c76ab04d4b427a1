// What load.urdf makes of correct files.
#include "loading.hpp"
#include "support/temporary_folder.hpp"

#include <gmock/gmock.h>

#include <clocale>
#include <fstream>
#include <numbers>

namespace foam::test {
namespace {

const Primitive& primitive(const Robot& robot, std::size_t index) {
    return std::get<Primitive>(robot.links.at(0).collisions.at(index).geometry);
}

TEST(LoadUrdf, ReadsEveryPrimitive) {
    const Robot robot = load_text(R"(<robot name="r"><link name="a">
        <collision><geometry><box size="1 2e0 +3"/></geometry></collision>
        <collision><geometry><sphere radius=" 0.25 "/></geometry></collision>
        <collision><geometry><cylinder radius="0.5" length="2"/></geometry></collision>
        <collision><geometry><capsule radius="0.1" length="0"/></geometry></collision>
    </link></robot>)");
    ASSERT_EQ(robot.links[0].collisions.size(), 4u);
    EXPECT_EQ(primitive(robot, 0), (Primitive{.kind = Primitive::Kind::box, .size = {1, 2, 3}}));
    EXPECT_EQ(primitive(robot, 1), (Primitive{.kind = Primitive::Kind::sphere, .radius = 0.25}));
    EXPECT_EQ(primitive(robot, 2), (Primitive{.kind = Primitive::Kind::cylinder, .radius = 0.5, .length = 2}));
    EXPECT_EQ(primitive(robot, 3), (Primitive{.kind = Primitive::Kind::capsule, .radius = 0.1, .length = 0}));
}

TEST(LoadUrdf, OriginMayLackAnyPart) {
    const Robot robot = load_text(R"(<robot name="r"><link name="a">
        <collision><geometry><sphere radius="1"/></geometry></collision>
        <collision><origin xyz="1 2 3"/><geometry><sphere radius="1"/></geometry></collision>
        <collision><origin rpy="0 0 1.5707963267948966"/><geometry><sphere radius="1"/></geometry></collision>
        <collision><origin/><geometry><sphere radius="1"/></geometry></collision>
    </link></robot>)");
    const std::vector<GeometryElement>& elements = robot.links[0].collisions;
    EXPECT_EQ(elements[0].origin, Pose{});
    EXPECT_EQ(elements[1].origin * Vec3{}, (Vec3{1, 2, 3}));
    EXPECT_NEAR(distance(elements[2].origin * Vec3{1, 0, 0}, {0, 1, 0}), 0, 1e-15);
    EXPECT_EQ(elements[3].origin, Pose{});
}

TEST(LoadUrdf, KeepsNamesLinesAndSource) {
    const std::string text =
        "<?xml version='1.0'?>\r\n<!-- <link> -->\r\n<robot name='r &amp; d'>\r\n<link name='a'>\r\n"
        "  <collision name='c'><geometry><sphere radius='1'/></geometry></collision>\r\n</link></robot>";
    const Robot robot = load_text(text);
    EXPECT_EQ(robot.name, "r & d");
    EXPECT_EQ(robot.root, "a");
    EXPECT_EQ(robot.source, text);
    EXPECT_EQ(robot.file, "/none/robot.urdf");
    EXPECT_EQ(robot.links[0].collisions[0].name, "c");
    EXPECT_EQ(robot.links[0].collisions[0].line, 5);
}

TEST(LoadUrdf, ReadsByteOrderMarksAndOtherEncodings) {
    ListeningContext context;
    EXPECT_EQ(
        load_text("\xEF\xBB\xBF<?xml version='1.0'?>\n<robot name='\xC3\xA9'><link name='a'/></robot>", context).name,
        "\xC3\xA9");
    EXPECT_EQ(
        load_text("<?xml version='1.0' encoding='ISO-8859-1'?><robot name='\xE9'><link name='a'/></robot>", context)
            .name,
        "\xC3\xA9");
    EXPECT_TRUE(context.messages.empty()) << context.messages.front();
}

TEST(LoadUrdf, ReadsJoints) {
    const Robot robot = load_text(R"(<robot name="r"><link name="a"/><link name="b"/><link name="c"/>
        <joint name="j" type="revolute"><parent link="a"/><child link="b"/><origin xyz="0 0 1"/><axis xyz="0 0 2"/>
            <limit lower="0.5" upper="1.5" effort="1" velocity="1"/></joint>
        <joint name="k" type="fixed"><parent link="b"/><child link="c"/><origin xyz="1 0 0"/><axis xyz="0 0 0"/></joint>
        </robot>)");
    EXPECT_EQ(robot.joints[0].kind, Joint::Kind::revolute);
    EXPECT_EQ(robot.joints[0].axis, (Vec3{0, 0, 1}));
    EXPECT_EQ(robot.joints[0].lower, 0.5);
    const std::map<std::string, Pose> poses = link_poses(robot, {{"j", std::numbers::pi / 2}});
    EXPECT_NEAR(distance(poses.at("c").translation, {0, 1, 1}), 0, 1e-15);
}

class LoadUrdfMeshes : public testing::Test {
protected:
    void SetUp() override {
        folder = temporary.path() / "with a space";
        std::filesystem::create_directories(folder / "pkg" / "meshes");
        std::ofstream(folder / "pkg" / "meshes" / "a b.stl") << "solid";
    }
    const TemporaryFolder temporary;
    std::filesystem::path folder;
};

TEST_F(LoadUrdfMeshes, ScaleMayMirrorAndTheSameMeshMayComeTwice) {
    QuietContext context;
    const Robot robot = load_text(R"(<robot name="r"><link name="a">
        <collision><origin xyz="1 0 0"/><geometry><mesh filename="package://pkg/meshes/a%20b.stl" scale="1 -1 0.5"/></geometry></collision>
        <collision><geometry><mesh filename="package://pkg/meshes/a b.stl"/></geometry></collision></link></robot>)",
                                  context, folder / "robot.urdf");
    const auto& first = std::get<MeshReference>(robot.links[0].collisions[0].geometry);
    const auto& second = std::get<MeshReference>(robot.links[0].collisions[1].geometry);
    EXPECT_EQ(first.scale, (Vec3{1, -1, 0.5}));
    EXPECT_EQ(second.scale, (Vec3{1, 1, 1}));
    EXPECT_EQ(first.path, folder / "pkg/meshes/a b.stl");
    EXPECT_EQ(first.path, second.path);
    EXPECT_EQ(first.uri, "package://pkg/meshes/a%20b.stl");
}

TEST_F(LoadUrdfMeshes, MissingOrOddVisualsAreOnlySaid) {
    ListeningContext context;
    const Robot robot = load_text(R"(<robot name="r"><link name="a">
        <visual><geometry><mesh filename="none.dae"/></geometry></visual>
        <visual><geometry><plane/></geometry></visual></link></robot>)",
                                  context, folder / "robot.urdf");
    ASSERT_EQ(robot.links[0].visuals.size(), 1u);
    EXPECT_TRUE(std::get<MeshReference>(robot.links[0].visuals[0].geometry).path.empty());
    EXPECT_THAT(context.messages, testing::ElementsAre(testing::HasSubstr("unknown geometry <plane>"),
                                                       testing::HasSubstr("1 visual meshes are not found")));
}

TEST(LoadUrdf, SaysWhatUrdfdomRefuses) {
    ListeningContext context;
    load_text(R"(<robot name="r"><link name="a"><inertial><mass value="heavy"/></inertial></link></robot>)", context);
    ASSERT_FALSE(context.messages.empty());
    EXPECT_THAT(context.messages.front(), testing::HasSubstr("urdfdom: "));
}

TEST(LoadUrdf, RobotWithoutNameIsCalledAfterItsFile) {
    ListeningContext context;
    EXPECT_EQ(load_text(R"(<robot><link name="a"/></robot>)", context, "/none/arm.urdf").name, "arm");
    EXPECT_FALSE(context.messages.empty());
}

TEST(LoadUrdf, NumbersAreTheSameInEveryLocale) {
    if (!std::setlocale(LC_ALL, "de_DE.UTF-8")) {
        GTEST_SKIP() << "the locale de_DE.UTF-8 is not installed";
    }
    const Robot robot = load_text(R"(<robot name="r"><link name="a"><collision><origin xyz="0.5 0 0"/>
        <geometry><sphere radius="0.25"/></geometry></collision></link></robot>)");
    std::setlocale(LC_ALL, "C");
    EXPECT_EQ(primitive(robot, 0).radius, 0.25);
    EXPECT_EQ(robot.links[0].collisions[0].origin.translation.x, 0.5);
}

} // namespace
} // namespace foam::test
