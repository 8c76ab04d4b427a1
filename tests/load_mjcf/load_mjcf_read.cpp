// What load.mjcf makes of correct files. The values are those that MuJoCo 4.0 compiles.
#include "loading.hpp"
#include "support/shared_folder.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace foam::test {
namespace {

constexpr double pi = std::numbers::pi;

const GeometryElement& geom(const Robot& robot, std::size_t index, const std::string& link = "world") {
    return link_of(robot, link).collisions.at(index);
}

const Element& primitive(const Robot& robot, std::size_t index) {
    return std::get<Element>(geom(robot, index).geometry);
}

TEST(LoadMjcf, ReadsEveryPrimitive) {
    const Robot robot = load_world(R"(<geom size=".5"/><geom type="capsule" size=".1 .2"/>
        <geom type="cylinder" size=".1 .3"/><geom type="box" size="1 2 3"/><geom type="ellipsoid" size="3 2 1"/>
        <geom type="plane" size="1 1 1"/>)");
    ASSERT_EQ(link_of(robot, "world").collisions.size(), 5u);
    EXPECT_EQ(primitive(robot, 0), (Element::sphere(0.5)));
    EXPECT_EQ(primitive(robot, 1), (Element::capsule(0.1, 0.4)));
    EXPECT_EQ(primitive(robot, 2), (Element::cylinder(0.1, 0.6)));
    EXPECT_EQ(primitive(robot, 3), (Element::box({2, 4, 6})));
    EXPECT_EQ(primitive(robot, 4), (Element::ellipsoid({3, 2, 1})));
}

TEST(LoadMjcf, StatesAPrimitiveByItsEnds) {
    const Robot robot = load_world(R"(<geom type="capsule" size=".1" fromto="0 0 0 2 0 0"/>
        <geom type="box" size=".1" fromto="0 0 -1 0 0 1"/>)");
    EXPECT_EQ(primitive(robot, 0), (Element::capsule(0.1, 2)));
    expect_at(geom(robot, 0).origin * Vec3{0, 0, 1}, {0, 0, 0}); // z leads from the second point to the first
    expect_at(geom(robot, 0).origin * Vec3{0, 0, -1}, {2, 0, 0});
    EXPECT_EQ(primitive(robot, 1), (Element::box({0.2, 0.2, 2})));
    expect_at(geom(robot, 1).origin * Vec3{0, 1, 0}, {0, -1, 0}); // half a turn about x
}

TEST(LoadMjcf, ReadsEveryOrientation) {
    const Robot robot = load_world(R"(<geom size="1" quat="1 1 0 0"/><geom size="1" axisangle="2 0 0 90"/>
        <geom size="1" euler="90 0 0"/><geom size="1" xyaxes="2 0 0 1 0 5"/><geom size="1" zaxis="0 -7 0" pos="1 2 3"/>)");
    for (std::size_t i = 0; i < 5; ++i) {
        const Pose& pose = geom(robot, i).origin;
        expect_at(pose.rotate({0, 0, 1}), {0, -1, 0});
        expect_at(pose.rotate({1, 0, 0}), {1, 0, 0});
    }
    expect_at(geom(robot, 4).origin * Vec3{}, {1, 2, 3});
}

TEST(LoadMjcf, LettersOfEulerseqChooseTheOrder) {
    const auto turned = [](const std::string& compiler) {
        const Robot robot = load_world(R"(<geom size="1" euler="90 90 0"/>)", compiler);
        return geom(robot, 0).origin.rotate({1, 0, 0});
    };
    expect_at(turned(""), {0, 1, 0}); // about x, then about the y that turned along
    expect_at(turned("<compiler eulerseq='XYZ'/>"), {0, 0, -1});
    expect_at(turned("<compiler eulerseq='zyx'/>"), {0, 0, -1});
}

TEST(LoadMjcf, LaterCompilersReplaceWhatTheyState) {
    const Robot robot = load_world(R"(<geom size="1" euler="1.5707963267948966 0 0"/>)",
                                   "<compiler angle='radian' eulerseq='zyx'/><compiler eulerseq='xyz'/>");
    expect_at(geom(robot, 0).origin.rotate({0, 0, 1}), {0, -1, 0});
}

TEST(LoadMjcf, ClassesInherit) {
    const Robot robot =
        load_world(R"(<geom/><geom class="b"/><body name="x" childclass="a"><geom/><geom class="b" size=".3"/>
        <body name="y"><frame childclass="b"><geom euler="0 90 0"/></frame><geom/></body></body>)",
                   R"(<default><geom size=".1 .2"/>
        <default class="a"><geom type="capsule"/><default class="b"><geom size=".4" axisangle="1 0 0 90"/></default></default>
    </default>)");
    EXPECT_EQ(primitive(robot, 0), (Element::sphere(0.1)));
    EXPECT_EQ(primitive(robot, 1), (Element::capsule(0.4, 0.4))); // the second number of the size is inherited
    const auto element = [&](const char* link, std::size_t i) {
        return std::get<Element>(geom(robot, i, link).geometry);
    };
    EXPECT_EQ(element("x", 0), (Element::capsule(0.1, 0.4)));
    EXPECT_EQ(element("x", 1), (Element::capsule(0.3, 0.4)));
    EXPECT_EQ(element("y", 0), (Element::capsule(0.4, 0.4)));
    EXPECT_EQ(element("y", 1), (Element::capsule(0.1, 0.4)));
    expect_at(geom(robot, 0, "y").origin.rotate({0, 0, 1}), {1, 0, 0}); // euler replaces axisangle
    expect_at(geom(robot, 1, "x").origin.rotate({0, 0, 1}), {0, -1, 0});
}

TEST(LoadMjcf, BodiesAreLinksAndFramesAreNone) {
    const Robot robot = load_world(R"(<frame pos="1 0 0" euler="0 0 90"><body name="a" pos="0 1 0">
        <frame pos="0 0 2"><geom size="1" pos="1 0 0"/><body name="b" pos="1 0 0"/></frame></body></frame>)");
    EXPECT_EQ(robot.root, "world");
    EXPECT_EQ(robot.links.size(), 3u);
    expect_at(in_world(robot, "a", {}), {0, 0, 0});
    expect_at(in_world(robot, "b", {}), {0, 1, 2});
    expect_at(in_world(robot, "a", geom(robot, 0, "a").origin * Vec3{}), {0, 1, 2});
    EXPECT_EQ(robot.joints[0].kind, Joint::Kind::fixed);
}

TEST(LoadMjcf, CallsBodiesWithoutANameByTheirNumber) {
    const Robot robot = load_world("<body><body/></body><body name='x'/><body><joint/></body>");
    std::vector<std::string> names;
    for (const Link& link : robot.links) {
        names.push_back(link.name);
    }
    EXPECT_THAT(names, testing::ElementsAre("world", "body_1", "body_2", "x", "body_4"));
    EXPECT_EQ(robot.joints.back().name, "joint_0");
}

TEST(LoadMjcf, CopiesWhatIsReplicated) {
    const Robot robot = load_world(R"(<replicate count="3" offset="1 0 0" euler="0 0 90" sep="_">
        <body name="r" pos="0 0 1"><geom name="g" size="1"/></body></replicate>
        <replicate count="11" offset="0 0 1"><geom size="1"/></replicate>)");
    expect_at(in_world(robot, "r_0", {}), {0, 0, 1});
    expect_at(in_world(robot, "r_1", {}), {1, 0, 1});
    expect_at(in_world(robot, "r_2", {}), {1, 1, 1}); // each stands in the frame of the one before
    expect_at(in_world(robot, "r_1", {1, 0, 0}), {1, 1, 1});
    EXPECT_EQ(geom(robot, 0, "r_2").name, "g_2");
    EXPECT_EQ(link_of(robot, "world").collisions.size(), 11u);
    const Robot many = load_world("<replicate count='10'><body name='x'/></replicate>");
    EXPECT_NE(many.find_link("x09"), nullptr); // as many digits as the count has
    const Robot nested = load_world(
        "<replicate count='2' sep='a'><replicate count='2' sep='b'><body name='x'/></replicate></replicate>");
    EXPECT_NE(nested.find_link("xb0a1"), nullptr);
}

TEST(LoadMjcf, AttachesModels) {
    const TemporaryFolder folder;
    write(folder.path() / "parts" / "hand.xml", R"(<mujoco model="hand"><compiler angle="radian"/>
        <default><default class="d"><geom size=".25"/></default></default>
        <worldbody><geom size=".5" pos="0 0 1"/><body name="palm" pos="0 1 0" childclass="d" euler="0 0 1.5707963267948966">
        <geom name="g"/><body name="finger" pos="1 0 0"><joint name="j" axis="1 0 0"/><geom/></body></body></worldbody></mujoco>)");
    const std::string text = R"(<mujoco><asset><model name="h" file="parts/hand.xml"/></asset><worldbody>
        <body name="arm" pos="0 0 2"><attach model="h" body="palm" prefix="left_"/></body>
        <frame pos="5 0 0"><attach model="h" body="finger" prefix="f_"/><attach model="h" prefix="all_"/></frame>
        </worldbody></mujoco>)";
    QuietContext context;
    const Robot robot = load_mjcf(text, context, folder.path() / "robot.xml");
    expect_at(in_world(robot, "left_palm", {}), {0, 1, 2});
    expect_at(in_world(robot, "left_finger", {}), {0, 2, 2});
    EXPECT_EQ(std::get<Element>(geom(robot, 0, "left_palm").geometry), (Element::sphere(0.25)));
    EXPECT_EQ(geom(robot, 0, "left_palm").name, "left_g");
    expect_at(in_world(robot, "f_finger", {}), {6, 0, 0});
    EXPECT_EQ(std::get<Element>(geom(robot, 0, "f_finger").geometry), (Element::sphere(0.25)));
    expect_at(in_world(robot, "all_palm", {}), {5, 1, 0});
    expect_at(geom(robot, 0).origin * Vec3{}, {5, 0, 1});
    EXPECT_EQ(robot.joints[2].name, "left_j");
}

TEST(LoadMjcf, SplicesIncludedFiles) {
    const TemporaryFolder folder;
    write(folder.path() / "sub" / "a.xml",
          "<mujocoinclude><compiler angle='radian'/><include file='b.xml'/></mujocoinclude>");
    write(folder.path() / "sub" / "b.xml",
          "<x><worldbody><body name='b'><include file='c.xml'/></body></worldbody></x>");
    write(folder.path() / "c.xml", "<x><geom size='1' euler='1.5707963267948966 0 0'/></x>"); // beside the main file
    QuietContext context;
    const Robot robot =
        load_mjcf("<mujoco><include file='sub\\\\a.xml'/></mujoco>", context, folder.path() / "robot.xml");
    expect_at(geom(robot, 0, "b").origin.rotate({0, 0, 1}), {0, -1, 0});
    EXPECT_EQ(robot.further_files, (std::vector<std::filesystem::path>{folder.path() / "c.xml", folder.path() / "sub" / "a.xml",
                                                                       folder.path() / "sub" / "b.xml"}));
}

TEST(LoadMjcf, ABodyMayHaveSeveralJoints) {
    const Robot robot = load_world(R"(<body name="a" pos="1 0 0">
        <joint name="s" type="slide" axis="0 0 2" range="-1 2"/><joint name="h" axis="0 0 1" pos="1 0 0"/>
        <joint name="k" axis="1 0 0" range="-90 45"/><geom size="1"/></body>)");
    expect_at(in_world(robot, "a", {}), {1, 0, 0});
    expect_at(in_world(robot, "a", {}, {{"s", 0.5}}), {1, 0, 0.5});
    expect_at(in_world(robot, "a", {}, {{"h", pi / 2}}), {2, -1, 0});
    expect_at(in_world(robot, "a", {0, 1, 0}, {{"h", pi / 2}, {"k", pi / 2}}), {2, -1, 1});
    ASSERT_EQ(robot.joints.size(), 3u);
    EXPECT_EQ(robot.joints[0].kind, Joint::Kind::prismatic);
    EXPECT_EQ(robot.joints[0].upper, 2);
    EXPECT_EQ(robot.joints[1].kind, Joint::Kind::continuous);
    EXPECT_EQ(robot.joints[2].kind, Joint::Kind::revolute);
    EXPECT_DOUBLE_EQ(robot.joints[2].lower, -pi / 2);
    EXPECT_EQ(robot.links.size(), 4u); // two links without geometry between the joints
}

TEST(LoadMjcf, AJointTurnsAboutItsAnchor) {
    const Robot robot =
        load_world(R"(<body name="a" pos="1 0 0"><joint name="h" pos="-1 0 0" axis="0 1 0"/><geom size="1"/></body>)");
    expect_at(in_world(robot, "a", {}, {{"h", pi / 2}}), {0, 0, -1});
    EXPECT_EQ(robot.joints.back().kind, Joint::Kind::fixed);
}

TEST(LoadMjcf, TheReferenceIsThePositionInTheFile) {
    const Robot robot = load_world(R"(<body name="a"><joint name="h" ref="90" range="0 180"/><geom size="1"/>
        <body name="b"><joint name="s" type="slide" ref="2" range="0 5" axis="1 0 0"/></body></body>)");
    expect_at(in_world(robot, "a", {1, 0, 0}, {{"h", pi / 2}}), {1, 0, 0});
    expect_at(in_world(robot, "a", {1, 0, 0}, {{"h", pi}}), {0, 1, 0});
    expect_at(in_world(robot, "b", {}, {{"h", pi / 2}, {"s", 3}}), {1, 0, 0});
}

TEST(LoadMjcf, WhatHasNoNumberFloats) {
    const Robot robot = load_world(
        R"(<body name="a" pos="1 2 3"><freejoint name="f"/><body name="b"><joint name="b" type="ball"/></body>
        <body name="c"><joint name="c" type="slide"/></body></body><body name="d" mocap="true" pos="0 0 1"/>)");
    for (const Joint& joint : robot.joints) {
        EXPECT_EQ(joint.kind, Joint::Kind::floating) << joint.name;
    }
    expect_at(in_world(robot, "b", {}), {1, 2, 3});
}

TEST(LoadMjcf, LimitsMayBeSwitchedOff) {
    const auto kind = [](const std::string& joint, const std::string& compiler = "") {
        return load_world("<body><joint " + joint + "/></body>", compiler).joints.front().kind;
    };
    EXPECT_EQ(kind("range='0 1'"), Joint::Kind::revolute);
    EXPECT_EQ(kind("range='0 1' limited='false'"), Joint::Kind::continuous);
    EXPECT_EQ(kind("range='0 1' limited='auto'"), Joint::Kind::revolute);
    EXPECT_EQ(kind("range='0 1'", "<compiler autolimits='false'/>"), Joint::Kind::continuous);
    EXPECT_EQ(kind("range='0 1' limited='true'", "<compiler autolimits='false'/>"), Joint::Kind::revolute);
}

TEST(LoadMjcf, WhatHasNoContactIsSeenAlone) {
    ListeningContext context;
    const Robot robot = load_mjcf(R"(<mujoco><asset><material name="red" rgba="1 0 0 1"/></asset>
        <contact><pair geom1="p" geom2="q"/></contact><worldbody>
        <geom size="1" contype="0"/><geom size="2" contype="0" conaffinity="0" material="red"/>
        <geom size="3" group="3"/><geom name="p" size="4" contype="0" conaffinity="0"/><geom name="q" type="plane" size="1 1 1"/>
        </worldbody></mujoco>)",
                                  context);
    const Link& world = link_of(robot, "world");
    ASSERT_EQ(world.collisions.size(), 3u);
    EXPECT_EQ(primitive(robot, 0), (Element::sphere(1)));
    EXPECT_EQ(primitive(robot, 1), (Element::sphere(3)));
    EXPECT_EQ(primitive(robot, 2), (Element::sphere(4)));
    ASSERT_EQ(world.visuals.size(), 3u); // the third is of a group that is hidden at first
    ASSERT_NE(world.visuals[1].material, nullptr);
    EXPECT_EQ(world.visuals[1].material->rgba, (std::array<double, 4>{1, 0, 0, 1}));
    EXPECT_THAT(
        context.messages,
        testing::ElementsAre("1 plane or height field with contact: no elements cover a plane or a height field"));
}

TEST(LoadMjcf, APairNeedsBothGeoms) {
    const TemporaryFolder folder;
    write(folder.path() / "hand.xml", R"(<mujoco><contact><pair geom1="a" geom2="b"/></contact><default>
        <geom size="1" contype="0" conaffinity="0"/></default><worldbody><body name="p"><geom name="a"/>
        <body name="q"><geom name="b"/></body></body></worldbody></mujoco>)");
    QuietContext context;
    const Robot robot = load_mjcf(R"(<mujoco><asset><model name="h" file="hand.xml"/></asset><worldbody>
        <frame><attach model="h" body="p" prefix="x_"/><attach model="h" body="q" prefix="y_"/></frame></worldbody></mujoco>)",
                                  context, folder.path() / "robot.xml");
    EXPECT_EQ(link_of(robot, "x_p").collisions.size(), 1u);
    EXPECT_EQ(link_of(robot, "x_q").collisions.size(), 1u);
    EXPECT_TRUE(link_of(robot, "y_q").collisions.empty()); // its partner is not attached
}

TEST(LoadMjcf, KeepsTheStatedMass) {
    const Robot robot = load_world("<body name='a'><inertial mass='2' pos='1 0 0' diaginertia='1 2 3'/></body>");
    const Inertial& inertial = link_of(robot, "a").inertial.value();
    EXPECT_EQ(inertial.mass, 2);
    EXPECT_EQ(inertial.moments, (std::array<double, 6>{1, 2, 3, 0, 0, 0}));
    expect_at(inertial.origin * Vec3{}, {1, 0, 0});
}

TEST(LoadMjcf, ReadsTheCaseFromOutside) {
    const std::filesystem::path folder = shared_folder() / "cases/robots/mjcf";
    if (!std::filesystem::exists(folder / "scene.xml")) {
        GTEST_SKIP() << "FOAM_SHARED is not set";
    }
    std::ifstream stream(folder / "scene.xml");
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    QuietContext context;
    const Robot robot = load_mjcf(text, context, folder / "scene.xml");
    EXPECT_EQ(robot.links.size(), 3u);
    EXPECT_EQ(std::get<Element>(geom(robot, 0, "base").geometry), (Element::capsule(0.05, 0.4)));
    EXPECT_NE(std::get<MeshReference>(geom(robot, 0, "foot").geometry).mesh, nullptr);
    EXPECT_TRUE(link_of(robot, "world").collisions.empty());
}

} // namespace
} // namespace foam::test
