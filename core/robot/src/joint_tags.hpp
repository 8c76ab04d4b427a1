// What a URDF has for its joints beyond foam::Joint: the values of <mimic>, and whether there is a <limit>.
#pragma once

#include <foam/robot/robot.hpp>

#include <map>
#include <optional>
#include <string>

namespace foam::inline robot {

struct Mimic {
    std::string joint;
    double multiplier = 1, offset = 0;
};

struct JointTags {
    int line = 0; ///< of <joint>, 1-based
    bool limited = false;
    std::optional<Mimic> mimic;
};

/// Returns the tags by joint name. Empty if the source is not a URDF. Throws Error(input) for an invalid <mimic>.
std::map<std::string, JointTags> read_joint_tags(const Robot& robot);

} // namespace foam::robot
