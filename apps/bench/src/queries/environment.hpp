// Random boxes and spheres around a robot.
#pragma once

#include <foam/base/random.hpp>
#include <foam/bench/collision_engine.hpp>
#include <foam/robot/kinematics.hpp>

#include <vector>

namespace foam::inline bench {

struct EnvironmentRule {
    std::size_t obstacles = 16;            ///< boxes and spheres in turn
    double smallest = 0.05, largest = 0.3; ///< m; of edges and diameters, uniform
};

/// Returns a rotation uniform over all rotations.
Pose random_rotation(Random& random);
/// The bounds of bodies in their own frames.
std::vector<Box> body_bounds(const EngineRobot& robot);
/// Where the robot is over `samples` random configurations. `links`: of each body, its index in the robot's links.
Box reach(const Kinematics& kinematics, const std::vector<std::size_t>& links, const std::vector<Box>& bounds,
          Random& random, std::size_t samples = 500);
/// The bounds of the bodies that no joint moves, in the frame of the root.
std::vector<Box> immovable(const Kinematics& kinematics, const std::vector<std::size_t>& links,
                           const std::vector<Box>& bounds);

/// Centres uniform in the region, rotations uniform; none touches a box that is kept free: what hits a robot that
/// cannot move hits it in every configuration. Throws Error(usage) where there is no room.
std::vector<Obstacle> random_environment(const EnvironmentRule& rule, const Box& region,
                                         const std::vector<Box>& kept_free, Random& random);

} // namespace foam::bench
