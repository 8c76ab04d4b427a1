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
    EXPECT_THROW(group_states("<robot><group_state><joint name='a' value='x'/></group_state></robot>", "a"), Error);
}

} // namespace
} // namespace foam::test
