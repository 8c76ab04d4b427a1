// The SDF that write.sdf composes of a robot of another format, by libsdformat and load.sdf: the same robot.
#include "loading.hpp"

#include <foam/robot/kinematics.hpp>
#include <foam/sdk/model.hpp>

#include <sdf/sdf.hh>

#include <gmock/gmock.h>

namespace foam::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

constexpr const char* urdf = R"(<robot name="arm">
  <material name="blue"><color rgba="0 0 1 1"/></material>
  <link name="base"><inertial><origin xyz="0 0 0.1" rpy="0.1 0 0"/><mass value="2"/>
    <inertia ixx="0.02" iyy="0.03" izz="0.04" ixy="0.001" ixz="0.002" iyz="0.003"/></inertial>
    <visual><origin xyz="0 0 1" rpy="0 0.2 0"/><geometry><box size="1 2 3"/></geometry><material name="blue"/></visual>
    <collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <link name="turn"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <link name="slide"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <link name="spin"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <link name="tip"/>
  <joint name="turn" type="revolute"><parent link="base"/><child link="turn"/><origin xyz="0.1 0.2 0.3" rpy="0.4 0.5 0.6"/>
    <axis xyz="0 1 0"/><limit lower="-1" upper="2" effort="30" velocity="4"/><dynamics damping="0.5" friction="0.25"/></joint>
  <joint name="slider" type="prismatic"><parent link="turn"/><child link="slide"/><origin xyz="0 0 0.5" rpy="1 0 0"/>
    <axis xyz="1 0 0"/><limit lower="0" upper="0.3" effort="0" velocity="0"/></joint>
  <joint name="spinner" type="continuous"><parent link="slide"/><child link="spin"/><origin xyz="0.2 0 0"/><axis xyz="0 0.6 0.8"/>
    <mimic joint="turn"/></joint>
  <joint name="end" type="fixed"><parent link="spin"/><child link="tip"/><origin xyz="0 0 1" rpy="0 0 1"/></joint>
</robot>)";

/// Keeps the plugins that its stages come from.
class Written : public testing::Test {
protected:
    void SetUp() override {
        for (const char* plugin : {"/load_urdf.so", "/write_sdf.so"}) {
            const PluginRecord& record = registry.load(std::string(FOAM_TEST_PLUGINS) + plugin);
            ASSERT_TRUE(record.loaded()) << record.rejection;
        }
    }

    Robot robot_of(const std::string& text) {
        QuietContext quiet;
        return registry.make<RobotLoader>("load.urdf")->load(text, "/robots/arm.urdf", ResourceResolver{}, quiet);
    }

    /// Returns the SDF of the robot with a sphere for each link that has collision geometry.
    std::string written(const Robot& robot) {
        SphereModel model;
        model.name = "arm";
        model.robot = std::make_shared<const Robot>(robot);
        for (const Link& link : robot.links) {
            if (!link.collisions.empty()) {
                SphereGroup group;
                group.link = link.name;
                group.tree = flat_tree({{{0, 0, 0}, 0.125}});
                model.groups.push_back(std::move(group));
            }
        }
        return registry.make<Writer>("write.sdf")->write(model, context);
    }

    Registry registry;
    ListeningContext context;
};

TEST_F(Written, LinksStandAndMoveAsBefore) {
    const Robot before = robot_of(urdf);
    const std::string text = written(before);
    sdf::Root root;
    EXPECT_TRUE(root.LoadSdfString(text).empty()) << text;
    const Robot after = load_sdf(text);
    EXPECT_EQ(after.root, "base");
    const JointValues values{{"turn", 0.7}, {"slider", 0.2}, {"spinner", 1.1}};
    JointValues renamed = values;
    renamed.erase("turn");
    renamed["turn_joint"] = 0.7; // a link is called turn as well
    const auto poses = link_poses(before, values), again = link_poses(after, renamed);
    for (const Link& link : before.links) {
        const Pose &a = poses.at(link.name), &b = again.at(link.name);
        EXPECT_LT(norm(a.translation - b.translation), 1e-12) << link.name;
        EXPECT_LT(norm(a.rotate({1, 2, 3}) - b.rotate({1, 2, 3})), 1e-12) << link.name;
    }
}

TEST_F(Written, LimitsLossesMassesAndVisualsStay) {
    const Robot before = robot_of(urdf), after = load_sdf(written(before));
    const auto joint = [&](const std::string& name) {
        return *std::ranges::find(after.joints, name, [](const Joint& one) { return one.name; });
    };
    const Joint turn = joint("turn_joint");
    EXPECT_EQ(std::pair(turn.lower, turn.upper), std::pair(-1.0, 2.0));
    EXPECT_EQ(turn.effort, 30);
    EXPECT_EQ(turn.velocity, 4);
    EXPECT_EQ(turn.damping, 0.5);
    EXPECT_EQ(turn.friction, 0.25);
    EXPECT_EQ(joint("slider").kind, Joint::Kind::prismatic);
    EXPECT_FALSE(joint("slider").effort) << "0 is no limit";
    EXPECT_EQ(joint("spinner").kind, Joint::Kind::continuous);
    EXPECT_EQ(joint("end").kind, Joint::Kind::fixed);
    const Link &base = *after.find_link("base"), &was = *before.find_link("base");
    EXPECT_EQ(base.inertial->mass, was.inertial->mass);
    EXPECT_EQ(base.inertial->moments, was.inertial->moments);
    ASSERT_EQ(base.visuals.size(), 1U);
    EXPECT_EQ(base.visuals[0].material->rgba, (std::array<double, 4>{0, 0, 1, 1}));
    EXPECT_EQ(std::get<Element>(base.visuals[0].geometry).half, (Vec3{0.5, 1, 1.5}));
    EXPECT_EQ(std::get<Element>(base.collisions.at(0).geometry).radius, 0.125);
}

TEST_F(Written, SaysWhatSdfHasNot) {
    written(robot_of(urdf));
    EXPECT_THAT(context.messages, Contains(HasSubstr("Gazebo takes 1 kg for each; remedy: add <inertial> to the robot: "
                                                     "links: turn, slide, spin")));
    EXPECT_THAT(context.messages, Contains(HasSubstr("SDF 1.9 has no joints that follow others; these move by "
                                                     "themselves: spinner")));
}

TEST_F(Written, ARootCalledWorldIsTheWorld) {
    const Robot before = robot_of(R"(<robot name="r"><link name="world"/><link name="arm"><collision><geometry>
        <sphere radius="0.1"/></geometry></collision></link><joint name="j" type="revolute"><parent link="world"/>
        <child link="arm"/><origin xyz="1 2 3" rpy="0 0 1"/><axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="1"
        velocity="1"/></joint></robot>)");
    const std::string text = written(before);
    sdf::Root root;
    EXPECT_TRUE(root.LoadSdfString(text).empty()) << text;
    const Robot after = load_sdf(text);
    EXPECT_EQ(after.root, "world");
    const Pose a = link_poses(before, {{"j", 0.5}}).at("arm"), b = link_poses(after, {{"j", 0.5}}).at("arm");
    EXPECT_LT(norm(a.translation - b.translation), 1e-12);
    EXPECT_LT(norm(a.rotate({1, 2, 3}) - b.rotate({1, 2, 3})), 1e-12);
}

} // namespace
} // namespace foam::test
