// What load.urdf makes of correct files.
#include "loading.hpp"
#include "support/temporary_folder.hpp"

#include <gmock/gmock.h>

#include <clocale>
#include <fstream>
#include <numbers>

namespace foam::test {
namespace {

const Element& primitive(const Robot& robot, std::size_t index) {
    return std::get<Element>(robot.links.at(0).collisions.at(index).geometry);
}

TEST(LoadUrdf, ReadsEveryPrimitive) {
    const Robot robot = load_text(R"(<robot name="r"><link name="a">
        <collision><geometry><box size="1 2e0 +3"/></geometry></collision>
        <collision><geometry><sphere radius=" 0.25 "/></geometry></collision>
        <collision><geometry><cylinder radius="0.5" length="2"/></geometry></collision>
        <collision><geometry><capsule radius="0.1" length="0"/></geometry></collision>
    </link></robot>)");
    ASSERT_EQ(robot.links[0].collisions.size(), 4u);
    EXPECT_EQ(primitive(robot, 0), (Element::box({1, 2, 3})));
    EXPECT_EQ(primitive(robot, 1), (Element::sphere(0.25)));
    EXPECT_EQ(primitive(robot, 2), (Element::cylinder(0.5, 2)));
    EXPECT_EQ(primitive(robot, 3), (Element::capsule(0.1, 0)));
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

TEST(LoadUrdf, ReadsWhatFewUsersOfAJointNeed) {
    const Robot robot = load_text(R"(<robot name="r"><link name="a"/><link name="b"/><link name="c"/>
        <joint name="j" type="prismatic"><parent link="a"/><child link="b"/>
            <limit upper="1" effort=" 87 " velocity="2.5"/><dynamics damping="0.5" friction="0.25"/></joint>
        <joint name="k" type="revolute"><parent link="b"/><child link="c"/>
            <mimic joint="x"/><mimic joint="j" multiplier="-2" offset="0.5"/><dynamics damping="high"/></joint>
        </robot>)");
    const Joint &j = robot.joints[0], &k = robot.joints[1];
    EXPECT_TRUE(j.limited && !j.mimic && !k.limited && k.mimic);
    EXPECT_EQ(std::tuple(j.line, j.effort, j.velocity, j.damping, j.friction), std::tuple(2, 87, 2.5, 0.5, 0.25));
    EXPECT_FALSE(k.effort || k.velocity || k.damping || k.friction);
    EXPECT_EQ(std::tuple(k.mimic->joint, k.mimic->multiplier, k.mimic->offset, k.mimic->problem),
              std::tuple("j", -2, 0.5, ""));
}

TEST(LoadUrdf, ReadsInertialsAsWritten) {
    const auto inertial = [](const std::string& inside) {
        return *load_text("<robot name='r'><link name='a'>\n<inertial>\n" + inside + "</inertial></link></robot>")
                    .links[0]
                    .inertial;
    };
    const std::string moments = "<inertia ixx='1' ixy='2' ixz='3' iyy='4' iyz='5' izz='6'/>";
    const Inertial whole = inertial("<origin xyz='1 2 3' rpy='0 0 1'/><mass value='7'/>" + moments);
    EXPECT_EQ(std::tuple(whole.mass, whole.line, whole.problem), std::tuple(7, 2, ""));
    EXPECT_EQ(*whole.moments, (std::array<double, 6>{1, 4, 6, 2, 3, 5}));
    EXPECT_EQ(whole.origin, Pose::from_xyz_rpy({1, 2, 3}, {0, 0, 1}));
    EXPECT_FALSE(inertial("<mass value='7'/>").moments);
    EXPECT_FALSE(inertial(moments).mass);
    // They are an error only for who needs them.
    EXPECT_EQ(inertial("<mass value='heavy'/>" + moments).problem,
              "/none/robot.urdf:3: value of <mass>: 'heavy' is not a finite number");
    EXPECT_EQ(inertial("<origin xyz='1 2'/><mass value='1'/>" + moments).problem,
              "/none/robot.urdf:3: xyz of <origin> holds 2 numbers, not 3");
    EXPECT_EQ(inertial("<mass value='1'/>\n<inertia ixx='1'/>").problem,
              "/none/robot.urdf:4: <inertia> has no ixy; remedy: add ixy=\"…\"");
    EXPECT_FALSE(load_text("<robot name='r'><link name='a'/></robot>").links[0].inertial);
}

TEST(LoadUrdf, ResolvesMaterials) {
    const auto visual = [](const std::string& material) {
        return "<visual><geometry><sphere radius='1'/></geometry>" + material + "</visual>";
    };
    const std::string odd =
        "<visual><geometry><plane/></geometry><material name='late'><color rgba='0 1 0'/></material></visual>";
    const Robot robot = load_text(
        "<robot name='r'><material name='red'><color rgba='1 0 0 0.5'/></material><material name='wood'>"
        "<texture filename='wood.png'/></material><link name='a'>" +
        visual("<material name='red'/>") + visual("<material name='red'><color rgba='0 0 2 1'/></material>") +
        visual("<material name='late'/>") + visual("<material name='wood'/>") +
        visual("<material name='none'><color rgba='1 1'/></material>") + visual("") + odd + "</link></robot>");
    using Colour = std::array<double, 4>;
    const std::vector<GeometryElement>& visuals = robot.links[0].visuals;
    ASSERT_EQ(visuals.size(), 6u);
    EXPECT_EQ(visuals[0].material->rgba, (Colour{1, 0, 0, 0.5}));
    EXPECT_EQ(visuals[1].material->rgba, (Colour{0, 0, 2, 1})) << "its own one, as written";
    EXPECT_EQ(visuals[2].material->rgba, (Colour{0, 1, 0, 1})) << "of a later element, opaque";
    EXPECT_EQ(visuals[3].material->texture, "wood.png");
    EXPECT_FALSE(visuals[3].material->rgba || visuals[4].material->rgba);
    EXPECT_EQ(visuals[4].material->name, "none");
    EXPECT_FALSE(visuals[5].material);
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
        <visual><geometry><torus/></geometry></visual></link></robot>)",
                                  context, folder / "robot.urdf");
    ASSERT_EQ(robot.links[0].visuals.size(), 1u);
    EXPECT_TRUE(std::get<MeshReference>(robot.links[0].visuals[0].geometry).path.empty());
    EXPECT_THAT(context.messages, testing::ElementsAre(testing::HasSubstr("unknown geometry <torus>"),
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
