// sdformat, which Gazebo reads URDFs with: links that have <inertial> keep their spheres, others are dropped.
#include "models.hpp"

#include <sdf/sdf.hh>

#include <gmock/gmock.h>

namespace foam::test {
namespace {

using ::testing::ElementsAre;

/// A base and an arm that turns on it, a box each, without masses.
SphereModel without_masses() {
    const std::string link = "\"><collision><geometry><box size=\"1 2 3\"/></geometry></collision></link>";
    auto robot = std::make_shared<Robot>();
    robot->name = "arm";
    robot->root = "base";
    robot->file = "/none/arm.urdf";
    robot->source = "<robot name=\"arm\"><link name=\"base" + link + "<link name=\"upper" + link +
                    "<joint name=\"turn\" type=\"revolute\"><parent link=\"base\"/><child link=\"upper\"/>"
                    "<axis xyz=\"0 0 1\"/><limit lower=\"0\" upper=\"2\" effort=\"1\" velocity=\"1\"/></joint></robot>";
    const Element box = Element::box({1, 2, 3});
    SphereModel model;
    for (const char* name : {"base", "upper"}) {
        robot->links.push_back(
            {.name = name, .collisions = {{.origin = {}, .geometry = box, .name = {}, .line = 0}}, .visuals = {}});
        model.groups.push_back(group_of(name, {"box"}, flat_tree({{{0, 0, 0}, 1.9}, {{0, 0, 1.0 / 3}, 0.1 + 0.7}})));
        model.geometry[name] = Solid::make({{nullptr, box, Pose{}}});
    }
    Joint joint;
    joint.name = "turn";
    joint.kind = Joint::Kind::revolute;
    joint.parent = "base";
    joint.child = "upper";
    joint.upper = 2;
    robot->joints.push_back(joint);
    model.robot = std::move(robot);
    return model;
}

/// Link, its mass and its number of spheres, as sdformat reads the URDF with this `inertial`.
std::vector<std::string> read_links(const std::string& inertial) {
    QuietContext context;
    sdf::Root root;
    root.LoadSdfString(writer("write_urdf", "write.urdf", {{"inertial", inertial}})->write(without_masses(), context));
    std::vector<std::string> links;
    for (std::uint64_t i = 0; root.Model() && i < root.Model()->LinkCount(); ++i) {
        const sdf::Link& link = *root.Model()->LinkByIndex(i);
        links.push_back(link.Name() + " " + std::to_string(std::lround(link.Inertial().MassMatrix().Mass())) + " " +
                        std::to_string(link.CollisionCount()));
    }
    return links;
}

TEST(Gazebo, KeepsTheLinksThatHaveAnInertia) {
    EXPECT_THAT(read_links("all"), ElementsAre("base 6000 2", "upper 6000 2"));
    EXPECT_THAT(read_links("keep"), ElementsAre()) << "the reason for the parameter";
}

} // namespace
} // namespace foam::test
