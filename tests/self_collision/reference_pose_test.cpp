// The reference pose: one in which no links touch that can be apart.
#include "reference_robot.hpp"

#include <foam/base/error.hpp>
#include <foam/collision/reference_pose.hpp>

#include <gmock/gmock.h>

namespace foam::test {
namespace {

using Source = ReferenceConfiguration::Source;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

TEST(ReferencePose, IsZeroWhereNoLinksTouch) {
    const FoldingArm arm(0.9);
    const ReferenceConfiguration pose = reference_configuration(arm.kinematics, arm.solids);
    EXPECT_EQ(pose.source, Source::zero);
    EXPECT_EQ(pose.configuration, arm.kinematics.configuration());
    EXPECT_TRUE(pose.touching.empty());
}

TEST(ReferencePose, IsFoundWhereLinksTouchAtZeroAndMovesFewJoints) {
    const FoldingArm arm(0);
    const ReferenceConfiguration pose = reference_configuration(arm.kinematics, arm.solids);
    EXPECT_EQ(pose.source, Source::found);
    EXPECT_TRUE(reference_configuration(arm.kinematics, arm.solids, {.given = arm.named(pose.configuration)})
                    .touching.empty());
    EXPECT_EQ(pose.configuration[0], 0); // the shoulder does not matter
    EXPECT_NE(pose.configuration[1], 0);
    EXPECT_EQ(reference_configuration(arm.kinematics, arm.solids).configuration, pose.configuration);
    EXPECT_THAT(sentence_about(arm.kinematics, pose),
                HasSubstr("reference pose (found, for links touch with all joints at zero): elbow "));
}

TEST(ReferencePose, OfTheUserIsTakenAsItIs) {
    const FoldingArm arm(0);
    const ReferenceConfiguration pose =
        reference_configuration(arm.kinematics, arm.solids, {.given = {{"shoulder", 0.5}}});
    EXPECT_EQ(pose.source, Source::given);
    EXPECT_THAT(pose.configuration, ElementsAre(0.5, 0));
    EXPECT_THAT(pose.touching, ElementsAre(Pair(0, 2)));
    EXPECT_THAT(sentence_about(arm.kinematics, pose),
                HasSubstr("shoulder 0.5; the geometry of these links touches in it: base and hand"));
    EXPECT_THROW(reference_configuration(arm.kinematics, arm.solids, {.given = {{"wrist", 1}}}), Error);
}

TEST(ReferencePose, IsTheFirstStateInWhichNoLinksTouch) {
    const FoldingArm arm(0);
    const std::vector<GroupState> states{{"folded", {{"elbow", 0.01}}},
                                         {"of another robot", {{"wheel", 1}}},
                                         {"ready", {{"elbow", 2}, {"wheel", 1}}},
                                         {"later", {{"elbow", 2.5}}}};
    const ReferenceConfiguration pose = reference_configuration(arm.kinematics, arm.solids, {.named = states});
    EXPECT_EQ(pose.source, Source::named);
    EXPECT_EQ(pose.name, "ready");
    EXPECT_THAT(pose.configuration, ElementsAre(0, 2));
}

TEST(ReferencePose, IsNoStateOutsideTheLimits) {
    const FoldingArm arm(0.9);
    const std::vector<GroupState> states{{"far", {{"elbow", 99}}}, {"ready", {{"elbow", 2}}}};
    EXPECT_EQ(reference_configuration(arm.kinematics, arm.solids, {.named = states}).name, "ready");
}

TEST(ReferencePose, KeepsTheJointsOfAStateAndMovesOthers) {
    const FoldingArm arm(0);
    const ReferenceConfiguration pose =
        reference_configuration(arm.kinematics, arm.solids, {.named = {{"aside", {{"shoulder", 0.5}}}}});
    EXPECT_EQ(pose.source, Source::named);
    EXPECT_EQ(pose.name, "aside");
    EXPECT_EQ(pose.configuration[0], 0.5);
    EXPECT_NE(pose.configuration[1], 0);
}

/// A body with arms one above the other, as that of FoldingArm: each hand lies in the body for nine tenths of the elbow's
/// range.
std::shared_ptr<const Robot> robot_of_many_arms(int arms) {
    const auto ball = [](const Vec3& at, double radius) {
        return GeometryElement{Pose::from_xyz_rpy(at, {}), Element::sphere(radius), "", 0};
    };
    Robot robot;
    robot.name = robot.root = "body";
    robot.links = {Link{"body", {}, {}}};
    for (int i = 0; i < arms; ++i) {
        const std::string upper = "upper" + std::to_string(i), hand = "hand" + std::to_string(i);
        const auto z = static_cast<double>(i);
        robot.links.front().collisions.push_back(ball({0, 0, z}, 0.3));
        robot.links.push_back({upper, {ball({0.5, 0, 0}, 0.05)}, {}});
        robot.links.push_back({hand, {ball({-1, 0, 0}, 0.2)}, {}});
        robot.joints.push_back({.name = "shoulder" + std::to_string(i), .kind = Joint::Kind::revolute, .parent = "body",
                                .child = upper, .origin = Pose::from_xyz_rpy({0, 0, z}, {}), .axis = {0, 0, 1},
                                .lower = -3, .upper = 3});
        robot.joints.push_back({.name = "elbow" + std::to_string(i), .kind = Joint::Kind::revolute, .parent = upper,
                                .child = hand, .origin = Pose::from_xyz_rpy({1, 0, 0}, {}), .axis = {0, 0, 1},
                                .lower = -0.55, .upper = 0.55});
    }
    return std::make_shared<const Robot>(std::move(robot));
}

TEST(ReferencePose, OfManyLimbsIsFoundPairByPair) {
    const auto robot = robot_of_many_arms(6);
    const Kinematics kinematics(robot);
    LinkSolids solids;
    for (const Link& link : robot->links) {
        std::vector<Solid::Part> parts;
        for (const GeometryElement& element : link.collisions) {
            parts.push_back({nullptr, std::get<Element>(element.geometry), element.origin});
        }
        solids.push_back(Solid::make(std::move(parts)));
    }
    const ReferenceConfiguration pose = reference_configuration(kinematics, solids);
    EXPECT_EQ(pose.source, Source::found);
    EXPECT_TRUE(pose.touching.empty());
    EXPECT_TRUE(
        reference_configuration(kinematics, solids, {.given = moved_joints(kinematics, pose.configuration)}).touching.empty());
}

TEST(ReferencePose, OfTheUserLiesWithinTheLimits) {
    const FoldingArm arm(0.9);
    try {
        reference_configuration(arm.kinematics, arm.solids, {.given = {{"elbow", 99}}});
        FAIL() << "it was accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        EXPECT_STREQ(error.what(), "joint 'elbow' at 99 is beyond its limits, 0.9 to 3");
    }
}

TEST(ReferencePose, KeepsJointsThatAreHeld) {
    const FoldingArm arm(0);
    const ReferenceConfiguration pose =
        reference_configuration(arm.kinematics, arm.solids, {.held = {{"shoulder", -0.25}}});
    EXPECT_EQ(pose.source, Source::found);
    EXPECT_EQ(pose.configuration[0], -0.25);
    const ReferenceConfiguration stuck =
        reference_configuration(arm.kinematics, arm.solids, {.held = {{"elbow", 0.001}}});
    EXPECT_EQ(stuck.source, Source::worst);
    EXPECT_THAT(stuck.touching, ElementsAre(Pair(0, 2)));
}

TEST(GroupStates, OfAnSrdf) {
    const std::string srdf = "<?xml version='1.0'?>\n<robot name='arm'>\n<group_state name='home' group='arm'>\n"
                             "<joint name='elbow' value='1.5'/><joint name='ball' value='0 0 1'/></group_state>\n"
                             "<group_state name='bad' group='arm'/></robot>";
    const std::vector<GroupState> states = group_states(srdf, "arm.srdf");
    ASSERT_EQ(states.size(), 2u);
    EXPECT_EQ(states[0].name, "home");
    EXPECT_THAT(states[0].values, ElementsAre(Pair("elbow", 1.5)));
    EXPECT_TRUE(group_states("robot_cfg: {}\n", "a.yml").empty());
    EXPECT_TRUE(group_states("<mujoco/>", "a.xml").empty());
    const std::vector<GroupState> keys = group_states(
        "<mujoco><worldbody><body><freejoint/><body><joint name='a'/><body><joint name='c' type='slide'/></body></body>"
        "<body><joint name='b'/></body></body></worldbody><keyframe><key name='home' qpos='0 0 1 1 0 0 0 .1 .2 .3'/>"
        "<key name='short' qpos='0 0'/></keyframe></mujoco>",
        "a.xml");
    ASSERT_EQ(keys.size(), 1u) << "the numbers of the other are not those of the joints";
    EXPECT_EQ(keys[0].name, "home");
    EXPECT_EQ(keys[0].values, (JointValues{{"a", .1}, {"c", .2}, {"b", .3}}));
    EXPECT_THROW(group_states("<robot><group_state><joint name='a' value='x'/></group_state></robot>", "a"), Error);
}

} // namespace
} // namespace foam::test
