// Joint positions to link poses: closed forms, limits, mimic joints, random configurations, and what is refused.
#include "support/shared_folder.hpp"

#include <foam/base/error.hpp>
#include <foam/robot/held_joints.hpp>
#include <foam/robot/kinematics.hpp>
#include <foam/sdk/registry.hpp>
#include <foam/sdk/stage.hpp>

#include <gmock/gmock.h>

#include <fstream>
#include <iterator>
#include <limits>
#include <numbers>

namespace foam::test {
namespace {

namespace fs = std::filesystem;
using std::numbers::pi;
using ::testing::ElementsAre;

std::shared_ptr<const Robot> load(const std::string& text, const fs::path& file = "arm.urdf") {
    Registry registry;
    const PluginRecord& record = registry.load(fs::path(FOAM_TEST_PLUGINS) / "load_urdf.so");
    EXPECT_TRUE(record.loaded()) << record.rejection;
    QuietContext context;
    return std::make_shared<const Robot>(
        registry.make<RobotLoader>("load.urdf", {{"lenient", true}})->load(text, file, ResourceResolver{}, context));
}

std::string joint(const std::string& name, const std::string& type, const std::string& parent, const std::string& child,
                  const std::string& more = "") {
    return "<joint name='" + name + "' type='" + type + "'>\n<parent link='" + parent + "'/><child link='" + child +
           "'/>" + more + "</joint>\n";
}

/// Links a, b, c, d; those that no joint leads to are fixed to a.
std::string robot(std::string joints) {
    for (const std::string link : {"b", "c", "d"}) {
        if (joints.find("<child link='" + link + "'") == std::string::npos) {
            joints += joint("to_" + link, "fixed", "a", link);
        }
    }
    return "<robot name='arm'><link name='a'/><link name='b'/><link name='c'/><link name='d'/>\n" + joints + "</robot>";
}

std::string refusal(const std::string& joints) {
    try {
        const Kinematics kinematics(load(robot(joints)));
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::input);
        return error.what();
    }
    return "";
}

constexpr const char* limit = "<limit lower='-1' upper='2' effort='1' velocity='1'/>";
constexpr const char* z_axis = "<axis xyz='0 0 1'/>";
constexpr const char* one_along_x = "<origin xyz='1 0 0'/>";

void expect_near(const Vec3& a, const Vec3& b, double tolerance = 1e-12) {
    EXPECT_LE(distance(a, b), tolerance) << a.x << ' ' << a.y << ' ' << a.z << " and " << b.x << ' ' << b.y << ' '
                                         << b.z;
}

TEST(Kinematics, PlanarArmOfTwoLinks) {
    const Kinematics kinematics(load(robot(joint("shoulder", "revolute", "a", "b", std::string(limit) + z_axis) +
                                           joint("elbow", "continuous", "b", "c", std::string(one_along_x) + z_axis) +
                                           joint("tip", "fixed", "c", "d", one_along_x))));
    ASSERT_EQ(kinematics.freedoms().size(), 2u);
    Random random(1);
    for (int i = 0; i < 50; ++i) {
        const std::vector<double> q = kinematics.random_configuration(random);
        const std::vector<Pose> poses = kinematics.link_poses(q);
        expect_near(poses[2].translation, {std::cos(q[0]), std::sin(q[0]), 0});
        expect_near(poses[3].translation,
                    {std::cos(q[0]) + std::cos(q[0] + q[1]), std::sin(q[0]) + std::sin(q[0] + q[1]), 0});
        expect_near(poses[3].rotate({1, 0, 0}), {std::cos(q[0] + q[1]), std::sin(q[0] + q[1]), 0});
    }
}

TEST(Kinematics, AgreesWithLinkPosesOfOneConfiguration) {
    const auto arm = load(robot(
        joint("j", "revolute", "a", "b",
              std::string("<origin xyz='1 2 3' rpy='0.1 0.2 0.3'/><axis xyz='1 1 0'/>") + limit) +
        joint("k", "prismatic", "a", "c", std::string("<origin xyz='0 0 1' rpy='1 0 0'/><axis xyz='0 2 1'/>") + limit) +
        joint("l", "floating", "c", "d", one_along_x)));
    const Kinematics kinematics(arm);
    const std::vector<Pose> poses = kinematics.link_poses(std::vector<double>{0.5, 1.5});
    const auto expected = link_poses(*arm, {{"j", 0.5}, {"k", 1.5}});
    for (std::size_t i = 0; i < arm->links.size(); ++i) {
        EXPECT_EQ(poses[i], expected.at(arm->links[i].name)) << arm->links[i].name;
    }
    EXPECT_THAT(kinematics.joint_values(std::vector<double>{0.5, 1.5}), ElementsAre(0.5, 1.5, 0.0));
}

TEST(Kinematics, LimitsOfEveryKindOfJoint) {
    const Kinematics limited(
        load(robot(joint("r", "revolute", "a", "b", limit) +
                   joint("p", "prismatic", "b", "c", "<limit upper='0.04' effort='1' velocity='1'/>") +
                   joint("c", "continuous", "c", "d"))));
    const Kinematics bare(load(robot(joint("r", "revolute", "a", "b") + joint("f", "fixed", "b", "c") +
                                     joint("o", "planar", "c", "d", z_axis))));
    const auto range = [](const Freedom& f) { return std::tuple(f.joint, f.lower, f.upper); };
    ASSERT_EQ(limited.freedoms().size(), 3u);
    EXPECT_EQ(range(limited.freedoms()[0]), std::tuple("r", -1.0, 2.0));
    EXPECT_EQ(range(limited.freedoms()[1]), std::tuple("p", 0.0, 0.04));
    EXPECT_EQ(range(limited.freedoms()[2]), std::tuple("c", -pi, pi));
    ASSERT_EQ(bare.freedoms().size(), 1u);
    EXPECT_EQ(range(bare.freedoms()[0]), std::tuple("r", -pi, pi));
}

TEST(Kinematics, RandomConfigurationsFillTheLimits) {
    const Kinematics kinematics(load(robot(joint("r", "revolute", "a", "b", limit))));
    Random random(7);
    double lowest = 9, highest = -9, sum = 0;
    constexpr int count = 10000;
    for (int i = 0; i < count; ++i) {
        const double q = kinematics.random_configuration(random).front();
        lowest = std::min(lowest, q);
        highest = std::max(highest, q);
        sum += q;
    }
    EXPECT_GE(lowest, -1);
    EXPECT_LT(highest, 2);
    EXPECT_LT(highest - lowest, 3);
    EXPECT_GT(highest - lowest, 2.99);
    // Mean 0.5, five standard errors of 3/√12/√n.
    EXPECT_NEAR(sum / count, 0.5, 5 * 3 / std::sqrt(12.0 * count));
}

TEST(Kinematics, MimicJointsFollow) {
    const Kinematics kinematics(
        load(robot(joint("lead", "prismatic", "a", "b", limit) +
                   joint("second", "prismatic", "a", "c", "<mimic joint='third' multiplier='2' offset='0.5'/>") +
                   joint("third", "prismatic", "a", "d",
                         std::string("<mimic joint='lead' multiplier='-3' offset='1'/>") + limit))));
    ASSERT_EQ(kinematics.freedoms().size(), 1u);
    // third = 1 - 3 q, which its own limits do not stop; second = 0.5 + 2 third = 2.5 - 6 q.
    EXPECT_THAT(kinematics.joint_values(std::vector<double>{1.0}), ElementsAre(1.0, -3.5, -2.0));
    expect_near(kinematics.link_poses(std::vector<double>{1.0})[2].translation, {-3.5, 0, 0});
}

TEST(Kinematics, AJointThatFollowsAFixedOneStaysAtItsOffset) {
    const Kinematics kinematics(load(
        robot(joint("f", "fixed", "a", "b") + joint("m", "revolute", "b", "c", "<mimic joint='f' offset='0.25'/>"))));
    EXPECT_TRUE(kinematics.freedoms().empty());
    EXPECT_THAT(kinematics.joint_values({}), ElementsAre(0.0, 0.25, 0.0));
}

TEST(Kinematics, ConfigurationsByName) {
    const Kinematics kinematics(
        load(robot(joint("r", "revolute", "a", "b", "<limit lower='0.5' upper='2'/>") +
                   joint("s", "revolute", "b", "c", limit) + joint("m", "revolute", "c", "d", "<mimic joint='s'/>"))));
    EXPECT_THAT(kinematics.configuration(), ElementsAre(0.5, 0.0));
    EXPECT_THAT(kinematics.configuration({{"s", 7}}), ElementsAre(0.5, 7.0));
    const auto refused = [&](const std::string& name) {
        try {
            kinematics.configuration({{name, 0.0}});
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::usage);
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(refused("t"), "a value is given for joint 't', but robot 'arm' has no such joint");
    EXPECT_EQ(refused("m"), "a value is given for joint 'm', which follows another");
}

TEST(Kinematics, Refusals) {
    EXPECT_EQ(refusal(joint("r", "revolute", "a", "b", "<limit lower='2' upper='-1'/>")),
              "arm.urdf:2: the lower limit of joint 'r', 2, is above the upper one, -1");
    EXPECT_EQ(refusal(joint("p", "prismatic", "a", "b")),
              "arm.urdf:2: prismatic joint 'p' has no limits; remedy: <limit lower=\"…\" upper=\"…\"/>");
    EXPECT_EQ(refusal(joint("r", "revolute", "a", "b", "<mimic joint='s'/>")),
              "arm.urdf:2: joint 'r' is to follow joint 's', but there is no such joint");
    EXPECT_EQ(refusal(joint("r", "revolute", "a", "b", "<mimic multiplier='2'/>")),
              "arm.urdf:3: <mimic> does not say which joint it follows; remedy: <mimic joint=\"NAME\"/>");
    EXPECT_EQ(refusal(joint("r", "revolute", "a", "b", "<mimic joint='r' offset='one'/>")),
              "arm.urdf:3: <mimic offset>: 'one' is not a finite number");
    EXPECT_EQ(refusal(joint("r", "revolute", "a", "b", "<mimic joint='s'/>") +
                      joint("s", "revolute", "b", "c", "<mimic joint='r'/>")),
              "arm.urdf:2: joint 'r' follows itself: the <mimic> of its joints go round in a circle");
}

TEST(Kinematics, RobotsThatWereNotReadFromAUrdf) {
    Robot made;
    made.name = made.root = "a";
    made.links = {{.name = "a", .collisions = {}, .visuals = {}}, {.name = "b", .collisions = {}, .visuals = {}}};
    made.joints = {{.name = "j",
                    .kind = Joint::Kind::revolute,
                    .parent = "a",
                    .child = "b",
                    .origin = {},
                    .axis = {0, 0, 1},
                    .lower = -0.5,
                    .upper = 0.5}};
    const Kinematics kinematics(std::make_shared<const Robot>(made));
    ASSERT_EQ(kinematics.freedoms().size(), 1u);
    EXPECT_EQ(kinematics.freedoms()[0].lower, -0.5);
    made.joints[0].limited = false;
    EXPECT_EQ(Kinematics(std::make_shared<const Robot>(made)).freedoms()[0].lower, -pi);
    made.joints[0].mimic = Mimic{.joint = "k"};
    try {
        const Kinematics follows(std::make_shared<const Robot>(made));
        ADD_FAILURE() << "it follows no joint";
    } catch (const Error& error) { // no text has a line of it
        EXPECT_STREQ(error.what(), "joint 'j' is to follow joint 'k', but there is no such joint");
    }
}

TEST(Kinematics, HeldJointsStandStillWithThoseThatMimic) {
    const auto free = load(robot(joint("j", "revolute", "a", "b", "<axis xyz='0 0 1'/><origin xyz='1 0 0'/>"
                                                                  "<limit lower='-1' upper='2'/>") +
                                 joint("k", "revolute", "b", "c", "<mimic joint='j' multiplier='-2' offset='0.5'/>"
                                                                  "<limit lower='-9' upper='9'/>") +
                                 joint("l", "prismatic", "c", "d", "<limit lower='0' upper='1'/>")));
    const Kinematics moving(free), still(std::make_shared<const Robot>(with_joints_held(*free, {{"j", 0.7}})));
    ASSERT_EQ(still.freedoms().size(), 1u);
    EXPECT_EQ(still.freedoms().front().joint, "l");
    const auto there = moving.link_poses(std::vector{0.7, 0.4}), here = still.link_poses(std::vector{0.4});
    for (std::size_t i = 0; i < there.size(); ++i) {
        for (const Vec3& p : {Vec3{}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}) {
            EXPECT_LE(distance(there[i] * p, here[i] * p), 1e-15);
        }
    }
    EXPECT_EQ(why_not_held(*free, "j", 2), "");
    EXPECT_EQ(why_not_held(*free, "j", 2.5), "joint 'j' moves from -1 to 2 rad, and 2.5 is outside");
    EXPECT_EQ(why_not_held(*free, "k", 0), "joint 'k' follows joint 'j'; remedy: hold that one");
    EXPECT_EQ(why_not_held(*free, "x", 0).find("arm.urdf has no joint 'x'"), 0u);
    EXPECT_NE(why_not_held(*free, "l", std::numeric_limits<double>::quiet_NaN()), "");
    EXPECT_THROW(with_joints_held(*free, {{"j", 3}}), Error);
    EXPECT_EQ(tips_of(*free), std::vector<std::string>{"d"});
}

/// Freedoms counted in the files by hand: movable joints without those that mimic.
TEST(Kinematics, RobotsOfOthers) {
    const std::pair<const char*, std::size_t> robots[] = {
        {"panda/moveit_resources_panda_description/urdf/panda.urdf", 8},
        {"ur5/example-robot-data/robots/ur_description/urdf/ur5_robot.urdf", 6},
        {"iiwa/model.urdf", 7},
    };
    for (const auto& [file, freedoms] : robots) {
        const fs::path path = shared_folder() / "robots" / file;
        if (!fs::exists(path)) {
            GTEST_SKIP() << path << " is absent";
        }
        std::ifstream stream(path, std::ios::binary);
        const Kinematics kinematics(load(std::string{std::istreambuf_iterator<char>(stream), {}}, path));
        EXPECT_EQ(kinematics.freedoms().size(), freedoms) << file;
    }
}

} // namespace
} // namespace foam::test
