// urdfdom, which ROS, MoveIt and rviz read robots with, on what write.urdf writes.
#include "support/shared_folder.hpp"
#include "urdfdom_robot.hpp"

namespace foam::test {
namespace {

void expect_same_robot(const SphereModel& model) {
    const urdf::ModelInterfaceSharedPtr read = urdf::parseURDF(urdf_of(model));
    ASSERT_TRUE(read);
    EXPECT_EQ(read->links_.size(), model.robot->links.size());
    EXPECT_EQ(read->joints_.size(), model.robot->joints.size());
    const auto spheres = spheres_of(model);
    for (const auto& [name, link] : read->links_) {
        const auto expected = spheres.find(name);
        EXPECT_EQ(spheres_of(*link), expected == spheres.end() ? std::vector<Sphere>{} : expected->second) << name;
    }
    const Kinematics kinematics(model.robot);
    for (const std::vector<double>& configuration : configurations(kinematics)) {
        const JointValues values = joint_values(kinematics, configuration);
        for (const auto& [name, expected] : placed(model, kinematics, configuration)) {
            const urdf::Link& link = *read->getLink(name);
            const Pose pose = pose_of(link, values);
            const std::vector<Sphere> own = spheres_of(link);
            ASSERT_EQ(own.size(), expected.size());
            for (std::size_t i = 0; i < own.size(); ++i) {
                EXPECT_LT(distance(pose * own[i].center, expected[i].center), rounding) << name;
            }
        }
    }
}

TEST(Urdfdom, ReadsTheSameRobot) {
    expect_same_robot(spheres_on(panda()));
}

TEST(Urdfdom, ReadsTheRobotsOfOthers) {
    const std::filesystem::path robots = shared_folder() / "robots";
    if (!std::filesystem::is_directory(robots)) {
        GTEST_SKIP() << "FOAM_SHARED has no robots";
    }
    for (const char* file : {"panda/foam_variant/panda.urdf", "iiwa/model.urdf",
                             "fetch/fetch_description/fetch_foam.urdf", "stretch/foam_variant/stretch/stretch.urdf"}) {
        SCOPED_TRACE(file);
        expect_same_robot(spheres_on(robot_of(robots / file)));
    }
}

} // namespace
} // namespace foam::test
