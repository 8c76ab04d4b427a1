// Forward kinematics for many configurations: joint positions to link poses, with limits and mimic joints.
#pragma once

#include <foam/base/random.hpp>
#include <foam/robot/robot.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] robot {

/// A degree of freedom: a joint that moves and does not mimic another.
struct Freedom {
    std::string joint;
    double lower = 0, upper = 0; ///< rad or m; lower <= upper
};

/// The value of a joint as a function of the configuration: multiplier · configuration[freedom] + offset.
struct JointMotion {
    std::optional<std::size_t> freedom; ///< index into freedoms(); none: the value is always `offset`
    double multiplier = 1, offset = 0;
};

/// Forward kinematics of a robot. A configuration is one value for each freedom, in their order. Immutable; every query
/// is const and thread-safe.
class Kinematics {
public:
    /// Takes the limits from the robot. A continuous joint, and a revolute one without <limit>, turns from -π to π. A
    /// joint with <mimic> follows the other one and ignores its own limits; planar and floating joints stay at their
    /// origin. Throws Error(input) naming file and line for a <mimic> of an unknown joint or in a circle, reversed
    /// limits, and a prismatic joint without <limit>.
    explicit Kinematics(std::shared_ptr<const Robot> robot);
    ~Kinematics();
    Kinematics(const Kinematics&) = delete;
    Kinematics& operator=(const Kinematics&) = delete;

    const Robot& robot() const { return *robot_; }
    /// The freedoms in the order of robot().joints.
    const std::vector<Freedom>& freedoms() const { return freedoms_; }
    /// The motion of each joint of robot().joints.
    const std::vector<JointMotion>& motions() const { return motions_; }
    /// Index into robot().joints of the joint above each link of robot().links; none for the root.
    const std::vector<std::optional<std::size_t>>& joint_above() const { return joint_above_; }
    /// Index into robot().links of the link above each joint of robot().joints.
    const std::vector<std::size_t>& link_above() const { return link_above_; }

    /// Returns zero moved into the limits; values named in `values` are used unchanged, within the limits or not.
    /// Throws Error(usage) for a joint that the robot does not have, that mimics another, or that does not move.
    std::vector<double> configuration(const JointValues& values = {}) const;
    /// Returns a configuration uniform within the limits, each freedom independent; one draw per freedom.
    std::vector<double> random_configuration(Random& random) const;
    /// Returns the value of each joint of robot().joints, rad or m.
    std::vector<double> joint_values(std::span<const double> configuration) const;
    /// Returns the pose of each link of robot().links in the root link's frame.
    std::vector<Pose> link_poses(std::span<const double> configuration) const;
    /// Writes the same poses to existing memory: one pose for each link.
    void link_poses(std::span<const double> configuration, std::span<Pose> poses) const;

private:
    void connect();
    std::shared_ptr<const Robot> robot_;
    std::vector<Freedom> freedoms_;
    std::vector<JointMotion> motions_;
    std::vector<std::optional<std::size_t>> joint_above_;
    std::vector<std::size_t> link_above_;
    std::vector<std::size_t> order_; ///< links, each after the one above it
};

/// Returns the motion of a joint by `value` (rad or m) after its origin; planar, floating and fixed joints do not move.
Pose joint_motion(const Joint& joint, double value);

} // namespace robot
} // namespace foam
