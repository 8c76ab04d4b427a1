// sdformat, which Gazebo reads robots and objects with: the URDF of write.urdf, and the SDF of write.sdf.
#include "robots.hpp"
#include "support/shared_folder.hpp"

#include <sdf/sdf.hh>

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace foam::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Vec3 vector_of(const ignition::math::Vector3d& v) {
    return {v.X(), v.Y(), v.Z()};
}

Pose pose_of(const ignition::math::Pose3d& pose) {
    const ignition::math::Matrix3d m(pose.Rot());
    Pose result;
    for (unsigned row = 0; row < 3; ++row) {
        result.rotation[row] = {m(row, 0), m(row, 1), m(row, 2)};
    }
    result.translation = vector_of(pose.Pos());
    return result;
}

/// A text as sdformat reads it.
struct Read {
    explicit Read(const std::string& text) {
        for (const sdf::Error& error : root.LoadSdfString(text)) {
            ADD_FAILURE() << error.Message();
        }
        EXPECT_TRUE(root.Model());
    }
    const sdf::Model& model() const { return *root.Model(); }

    std::vector<std::string> links() const {
        std::vector<std::string> names;
        for (std::uint64_t i = 0; i < model().LinkCount(); ++i) {
            names.push_back(model().LinkByIndex(i)->Name());
        }
        std::sort(names.begin(), names.end());
        return names;
    }

    sdf::Root root;
};

/// The spheres of a link in its own frame.
std::vector<Sphere> spheres_of(const sdf::Link& link) {
    std::vector<Sphere> result;
    for (std::uint64_t i = 0; i < link.CollisionCount(); ++i) {
        const sdf::Collision& collision = *link.CollisionByIndex(i);
        EXPECT_EQ(collision.Geom()->Type(), sdf::GeometryType::SPHERE);
        if (const sdf::Sphere* sphere = collision.Geom()->SphereShape()) {
            result.push_back({vector_of(collision.RawPose().Pos()), sphere->Radius()});
        }
    }
    return result;
}

Pose motion_of(const sdf::Joint& joint, double value) {
    Pose pose;
    if (joint.Type() == sdf::JointType::FIXED) {
        return pose;
    }
    ignition::math::Vector3d axis;
    EXPECT_THAT(joint.Axis(0)->ResolveXyz(axis, joint.Name()), IsEmpty());
    if (joint.Type() == sdf::JointType::PRISMATIC) {
        pose.translation = vector_of(axis) * value;
        return pose;
    }
    return Pose::from_axis_angle(vector_of(axis.Normalized()), value);
}

/// The pose of a link at joint positions, from the root link.
Pose pose_of(const sdf::Model& model, const std::string& link, const JointValues& values) {
    for (std::uint64_t i = 0; i < model.JointCount(); ++i) {
        const sdf::Joint& joint = *model.JointByIndex(i);
        std::string child, parent;
        joint.ResolveChildLink(child);
        joint.ResolveParentLink(parent);
        if (child != link || parent == "world") {
            continue;
        }
        ignition::math::Pose3d in_parent, in_joint;
        EXPECT_THAT(joint.SemanticPose().Resolve(in_parent, parent), IsEmpty());
        EXPECT_THAT(model.LinkByName(link)->SemanticPose().Resolve(in_joint, joint.Name()), IsEmpty());
        const auto value = values.find(joint.Name());
        return pose_of(model, parent, values) * pose_of(in_parent) *
               motion_of(joint, value == values.end() ? 0 : value->second) * pose_of(in_joint);
    }
    return {};
}

/// The Panda with a mass for each link but those named.
std::shared_ptr<const Robot> panda_with_mass(const std::vector<std::string>& massless) {
    const auto robot = panda();
    std::string text = robot->source;
    for (const Link& link : robot->links) {
        const std::size_t at = text.find("<link name=\"" + link.name + "\"");
        std::size_t end = text.find('>', at);
        if (std::find(massless.begin(), massless.end(), link.name) != massless.end()) {
            continue;
        }
        const std::string mass =
            "<inertial><mass value=\"1\"/><inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" "
            "izz=\"1\"/></inertial>";
        if (text[end - 1] == '/') {
            text.replace(end - 1, 2, ">" + mass + "</link>");
        } else {
            text.insert(end + 1, mass);
        }
    }
    return robot_of(text, robot->file);
}

/// Returns the model with numbers of seven decimals, as foam's searches give them: sdformat keeps 16 digits of a URDF's
/// numbers, and some need 17.
SphereModel with_decimals(SphereModel model) {
    for (SphereGroup& group : model.groups) {
        for (Sphere& s : group.tree.levels.back().elements.spheres()) {
            for (double* number : {&s.center.x, &s.center.y, &s.center.z, &s.radius}) {
                *number = std::round(*number * 1e7) / 1e7;
            }
        }
    }
    return model;
}

/// Returns the text with fixed joints that stay.
std::string with_fixed_joints(std::string urdf, const Robot& robot) {
    std::string keep;
    for (const Joint& joint : robot.joints) {
        if (joint.kind == Joint::Kind::fixed) {
            keep += "<gazebo reference=\"" + joint.name + "\"><preserveFixedJoint>true</preserveFixedJoint></gazebo>\n";
        }
    }
    return urdf.insert(urdf.rfind("</robot>"), keep);
}

std::string urdf_of(const SphereModel& model) {
    QuietContext context;
    return writer("write_urdf", "write.urdf")->write(model, context);
}

TEST(Sdformat, ReadsTheSameRobotWhereFixedJointsStay) {
    const SphereModel model = with_decimals(spheres_on(panda_with_mass({})));
    const Read read(with_fixed_joints(urdf_of(model), *model.robot));
    EXPECT_EQ(read.model().LinkCount(), model.robot->links.size());
    const Kinematics kinematics(model.robot);
    const auto spheres = test::spheres_of(model);
    for (const auto& [name, expected] : spheres) {
        ASSERT_TRUE(read.model().LinkByName(name)) << name;
        EXPECT_EQ(spheres_of(*read.model().LinkByName(name)), expected) << name;
    }
    for (const std::vector<double>& configuration : configurations(kinematics)) {
        const JointValues values = joint_values(kinematics, configuration);
        for (const auto& [name, expected] : placed(model, kinematics, configuration)) {
            const Pose pose = pose_of(read.model(), name, values);
            for (std::size_t i = 0; i < expected.size(); ++i) {
                EXPECT_LT(distance(pose * spheres.at(name)[i].center, expected[i].center), rounding) << name;
            }
        }
    }
}

TEST(Sdformat, LumpsLinksOfFixedJointsIntoTheirParents) {
    const SphereModel model = spheres_on(panda_with_mass({}));
    const Read read(urdf_of(model));
    EXPECT_THAT(read.links(),
                ElementsAre("panda_leftfinger", "panda_link0", "panda_link1", "panda_link2", "panda_link3",
                            "panda_link4", "panda_link5", "panda_link6", "panda_link7", "panda_rightfinger"));
    // Those of the hand are beside those of link 7, at the same place.
    const std::vector<Sphere> seventh = spheres_of(*read.model().LinkByName("panda_link7"));
    ASSERT_EQ(seventh.size(), 4U);
    const auto zero = link_poses(*model.robot);
    const Pose from_hand = zero.at("panda_link7").inverse() * zero.at("panda_hand");
    const std::vector<Sphere> hand = test::spheres_of(model).at("panda_hand");
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_LT(distance(seventh[2 + i].center, from_hand * hand[i].center), 1e-9);
        EXPECT_EQ(seventh[2 + i].radius, hand[i].radius);
    }
}

TEST(Sdformat, DropsLinksWithoutMass) {
    const SphereModel model = spheres_on(panda_with_mass({"panda_rightfinger"}));
    sdf::Root root;
    root.LoadSdfString(urdf_of(model));
    ASSERT_TRUE(root.Model());
    EXPECT_TRUE(root.Model()->LinkByName("panda_leftfinger"));
    EXPECT_FALSE(root.Model()->LinkByName("panda_rightfinger"));
}

/// Expects every sphere of the model in a link of the other one, at the same place with all joints at zero.
void expect_all_spheres(const SphereModel& model, const Read& read) {
    std::vector<Sphere> missing;
    const auto zero = link_poses(*model.robot, [&] {
        JointValues values;
        for (const Joint& joint : model.robot->joints) {
            if (joint.kind != Joint::Kind::fixed) {
                values[joint.name] = 0;
            }
        }
        return values;
    }());
    for (const SphereGroup& group : model.groups) {
        for (const Sphere& s : group.tree.finest()) {
            missing.push_back({zero.at(group.link) * s.center, s.radius});
        }
    }
    for (const std::string& name : read.links()) {
        const Pose pose = pose_of(read.model(), name, {});
        for (const Sphere& s : spheres_of(*read.model().LinkByName(name))) {
            const auto same = std::find_if(missing.begin(), missing.end(), [&](const Sphere& other) {
                return s.radius == other.radius && distance(pose * s.center, other.center) < 1e-9;
            });
            ASSERT_NE(same, missing.end()) << name;
            missing.erase(same);
        }
    }
    EXPECT_THAT(missing, IsEmpty());
}

TEST(Sdformat, ReadsTheRobotsOfOthers) {
    const std::filesystem::path robots = shared_folder() / "robots";
    if (!std::filesystem::is_directory(robots)) {
        GTEST_SKIP() << "FOAM_SHARED has no robots";
    }
    for (const char* file : {"panda/foam_variant/panda.urdf", "fetch/fetch_description/fetch_foam.urdf",
                             "ur5/example-robot-data/robots/ur_description/urdf/ur5_robot.urdf",
                             "jaco/kinova_description/urdf/j2s7s300.urdf"}) {
        SCOPED_TRACE(file);
        const SphereModel model = with_decimals(spheres_on(robot_of(robots / file)));
        expect_all_spheres(model, Read(urdf_of(model)));
    }
    // The first link of this iiwa has a mass of 0: it is dropped, and all others with it.
    sdf::Root root;
    const sdf::Errors errors = root.LoadSdfString(urdf_of(spheres_on(robot_of(robots / "iiwa/model.urdf"))));
    ASSERT_FALSE(errors.empty());
    EXPECT_EQ(errors.front().Message(), "A model must have at least one link.");
}

TEST(Sdformat, ReadsObjects) {
    const SphereModel model = model_of(
        nullptr, {group_of("part", {}, flat_tree({{{0.1, -0.2, 1.0 / 3}, 0.05}, {{1e-17, 1234.5, -0.0}, 0.1 + 0.7}}))});
    QuietContext context;
    const Read read(writer("write_sdf", "write.sdf")->write(model, context));
    ASSERT_EQ(read.model().LinkCount(), 1U);
    EXPECT_EQ(spheres_of(*read.model().LinkByIndex(0)), model.groups[0].tree.finest());
}

} // namespace
} // namespace foam::test
