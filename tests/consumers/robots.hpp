// A robot with spheres whose numbers need all digits, and where its spheres are at a few joint positions.
#pragma once

#include "write/models.hpp"

#include <foam/base/random.hpp>
#include <foam/robot/kinematics.hpp>
#include <foam/sdk/stage.hpp>

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

namespace foam::test {

inline std::shared_ptr<const Robot> robot_of(const std::string& text, const std::filesystem::path& file) {
    Registry registry;
    registry.load(FOAM_TEST_PLUGINS "/load_urdf.so");
    QuietContext context;
    return std::make_shared<Robot>(
        registry.make<RobotLoader>("load.urdf")->load(text, file, ResourceResolver::from_environment(), context));
}

inline std::shared_ptr<const Robot> robot_of(const std::filesystem::path& file) {
    std::stringstream text;
    text << std::ifstream(file).rdbuf();
    return robot_of(text.str(), file);
}

inline std::shared_ptr<const Robot> panda() {
    return robot_of(std::filesystem::path(FOAM_TEST_SOURCE "/configs/robots/panda/panda.urdf"));
}

/// Two spheres on each link with collision geometry.
inline SphereModel spheres_on(const std::shared_ptr<const Robot>& robot) {
    SphereModel model;
    model.name = "test";
    model.robot = robot;
    model.facts.tool_frames = {robot->links.back().name};
    Random random(5);
    for (const Link& link : robot->links) {
        if (!link.collisions.empty()) {
            std::vector<Sphere> spheres;
            for (int i = 0; i < 2; ++i) {
                const double x = random.uniform(-0.1, 0.1), y = random.uniform(-0.1, 0.1);
                spheres.push_back({{x, y, (i + 1) / 30.0}, random.uniform(0.05, 0.1)});
            }
            model.groups.push_back(group_of(link.name, {}, flat_tree(spheres)));
        }
    }
    return model;
}

/// A sphere of a link, in the root link's frame.
using Placed = std::map<std::string, std::vector<Sphere>>;

/// Returns the spheres of each link at a configuration.
inline Placed placed(const SphereModel& model, const Kinematics& kinematics, const std::vector<double>& configuration) {
    const std::vector<Pose> poses = kinematics.link_poses(configuration);
    Placed result;
    for (const SphereGroup& group : model.groups) {
        const auto link = static_cast<std::size_t>(model.robot->find_link(group.link) - model.robot->links.data());
        for (const Sphere& sphere : group.tree.finest()) {
            result[group.link].push_back({poses[link] * sphere.center, sphere.radius});
        }
    }
    return result;
}

/// The default configuration and two others.
inline std::vector<std::vector<double>> configurations(const Kinematics& kinematics) {
    Random random(9);
    return {kinematics.configuration(), kinematics.random_configuration(random),
            kinematics.random_configuration(random)};
}

/// Returns the value of each joint that moves.
inline JointValues joint_values(const Kinematics& kinematics, const std::vector<double>& configuration) {
    JointValues result;
    const std::vector<double> values = kinematics.joint_values(configuration);
    for (std::size_t j = 0; j < values.size(); ++j) {
        if (kinematics.robot().joints[j].kind != Joint::Kind::fixed) {
            result[kinematics.robot().joints[j].name] = values[j];
        }
    }
    return result;
}

/// How far a product of rotations may be from the same product in another order, m.
constexpr double rounding = 1e-12;

} // namespace foam::test
