// An arm whose hand lies in its base where the elbow is folded.
#pragma once

#include <foam/collision/self_collision.hpp>

#include <memory>

namespace foam::test {

/// Spheres of .3, .05 and .2 m; the upper arm and the lower arm are 1 m long. The elbow's axis is that of the shoulder,
/// and at zero the hand lies in the base. `least`: lower limit of the elbow, rad.
struct FoldingArm {
    explicit FoldingArm(double least) : robot(made(least)), kinematics(robot) {
        for (const Link& link : robot->links) {
            const GeometryElement& ball = link.collisions.front();
            solids.push_back(Solid::make({{nullptr, std::get<Element>(ball.geometry), ball.origin}}));
        }
    }

    JointValues named(const std::vector<double>& configuration) const {
        return {{"shoulder", configuration[0]}, {"elbow", configuration[1]}};
    }

    std::shared_ptr<const Robot> robot;
    Kinematics kinematics;
    LinkSolids solids;

private:
    static std::shared_ptr<const Robot> made(double least) {
        const auto link = [](const std::string& name, const Vec3& at, double radius) {
            return Link{name, {{Pose::from_xyz_rpy(at, {}), Element::sphere(radius), "", 0}}, {}};
        };
        Robot robot;
        robot.name = "arm";
        robot.root = "base";
        robot.links = {link("base", {}, 0.3), link("upper", {0.5, 0, 0}, 0.05), link("hand", {-1, 0, 0}, 0.2)};
        robot.joints = {{.name = "shoulder", .kind = Joint::Kind::revolute, .parent = "base", .child = "upper",
                         .origin = {}, .axis = {0, 0, 1}, .lower = -3, .upper = 3},
                        {.name = "elbow", .kind = Joint::Kind::revolute, .parent = "upper", .child = "hand",
                         .origin = Pose::from_xyz_rpy({1, 0, 0}, {}), .axis = {0, 0, 1}, .lower = least, .upper = 3}};
        return std::make_shared<const Robot>(std::move(robot));
    }
};

} // namespace foam::test
