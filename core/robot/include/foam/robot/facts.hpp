// What programs state of a robot beyond its URDF.
#pragma once

#include <foam/robot/robot.hpp>

#include <optional>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] robot {

/// What formats state of a robot beyond its URDF: keys of a recipe's `robot`, the same for all writers.
struct RobotFacts {
    std::string base_link;                ///< empty: the root link
    std::vector<std::string> tool_frames; ///< links
    JointValues lock_joints;              ///< joints that a planner is to hold, and their positions; rad or m
    JointValues default_pose;             ///< rad or m; joints that are not named: zero, moved into the limits
    std::optional<double> acceleration;   ///< of every joint, rad/s² or m/s²
    std::optional<double> jerk;           ///< of every joint, rad/s³ or m/s³

    bool operator==(const RobotFacts&) const = default;
};

/// Two links that are left out of self-collision checks.
struct IgnoredPair {
    std::string first, second;
    std::string reason; ///< in the words of SRDFs: "Adjacent", "Never", …; may be empty
};

} // namespace robot
} // namespace foam
