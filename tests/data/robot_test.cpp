// Poses of links, and what writers are given of a model.
#include <foam/base/error.hpp>
#include <foam/sdk/model.hpp>

#include <gmock/gmock.h>

#include <numbers>

namespace foam {
namespace {

using testing::HasSubstr;

Joint joint(const std::string& name, Joint::Kind kind, const std::string& parent, const std::string& child) {
    Joint result;
    result.name = name;
    result.kind = kind;
    result.parent = parent;
    result.child = child;
    result.axis = {0, 0, 1};
    result.origin.translation = {1, 0, 0};
    return result;
}

Robot robot_of(std::vector<Joint> joints) {
    Robot robot;
    robot.name = "r";
    robot.root = "a";
    for (const char* name : {"a", "b", "c"}) {
        robot.links.push_back({name, {}, {}});
    }
    robot.joints = std::move(joints);
    return robot;
}

TEST(LinkPoses, FollowTheJoints) {
    // Joints need not come in the order of the tree.
    const Robot robot =
        robot_of({joint("k", Joint::Kind::prismatic, "b", "c"), joint("j", Joint::Kind::revolute, "a", "b")});
    EXPECT_EQ(link_poses(robot).at("c").translation, (Vec3{2, 0, 0}));
    const auto poses = link_poses(robot, {{"j", std::numbers::pi / 2}, {"k", 0.5}});
    EXPECT_EQ(poses.at("a"), Pose{});
    EXPECT_NEAR(distance(poses.at("c").translation, {1, 1, 0.5}), 0, 1e-15);
}

TEST(LinkPoses, ZeroIsMovedIntoTheLimits) {
    Joint slide = joint("j", Joint::Kind::prismatic, "a", "b");
    slide.lower = 0.25;
    slide.upper = 0.5;
    EXPECT_EQ(link_poses(robot_of({slide})).at("b").translation, (Vec3{1, 0, 0.25}));
    slide.lower = -0.5;
    slide.upper = -0.25;
    EXPECT_EQ(link_poses(robot_of({slide})).at("b").translation, (Vec3{1, 0, -0.25}));
    slide.lower = 1; // no value at all: limits the wrong way round count for nothing
    EXPECT_EQ(link_poses(robot_of({slide})).at("b").translation, (Vec3{1, 0, 0}));
    slide.kind = Joint::Kind::continuous;
    EXPECT_EQ(link_poses(robot_of({slide})).at("b").rotation, Pose{}.rotation);
}

TEST(LinkPoses, FixedFloatingAndPlanarJointsStay) {
    for (const Joint::Kind kind : {Joint::Kind::fixed, Joint::Kind::floating, Joint::Kind::planar}) {
        EXPECT_EQ(link_poses(robot_of({joint("j", kind, "a", "b")}), {{"j", 3.0}}).at("b").translation,
                  (Vec3{1, 0, 0}));
    }
}

TEST(LinkPoses, LeaveOutWhatTheRootDoesNotReach) {
    const auto poses =
        link_poses(robot_of({joint("j", Joint::Kind::fixed, "b", "c"), joint("k", Joint::Kind::fixed, "c", "b")}));
    EXPECT_EQ(poses.size(), 1u);
}

TEST(LinkPoses, RefuseUnknownJoints) {
    try {
        link_poses(robot_of({}), {{"elbow", 1.0}});
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        EXPECT_THAT(error.what(), HasSubstr("'elbow'"));
    }
}

TEST(Robot, FindsLinks) {
    const Robot robot = robot_of({});
    EXPECT_EQ(robot.find_link("b"), &robot.links[1]);
    EXPECT_EQ(robot.find_link("B"), nullptr);
    EXPECT_STREQ(to_string(Element::Kind::capsule), "capsule");
}

TEST(SpheresByLink, JoinsGroupsAndTakesTheLevel) {
    SphereModel model;
    for (const char* link : {"b", "a", "b"}) {
        model.groups.emplace_back();
        model.groups.back().link = link;
        model.groups.back().tree = flat_tree({{{0, 0, 0}, 1}, {{static_cast<double>(model.groups.size()), 0, 0}, 1}});
    }
    const std::vector<LinkSpheres> finest = spheres_by_link(model);
    ASSERT_EQ(finest.size(), 2u);
    EXPECT_EQ(finest[0].link, "b");
    ASSERT_EQ(finest[0].elements.spheres().size(), 4u);
    EXPECT_EQ(finest[0].elements.spheres()[1].center.x, 1);
    EXPECT_EQ(finest[0].elements.spheres()[3].center.x, 3);
    EXPECT_EQ(spheres_by_link(model, 0)[0].elements.size(), 2u);
    EXPECT_EQ(spheres_by_link(model, 9)[0].elements.size(), 4u);
    model.groups[2].tree.levels[0].elements.spheres()[0].radius = 0;
    EXPECT_NO_THROW(spheres_by_link(model));
    EXPECT_THROW(require_writable(model), Error);
    EXPECT_THROW(spheres_by_link(model, 0), Error);
}

} // namespace
} // namespace foam
