// What a URDF says of its joints beyond foam::Joint: the order of <mimic>, and whether there is a <limit> at all.
#pragma once

#include <foam/robot.hpp>

#include <map>
#include <optional>
#include <string>

namespace foam {

struct Mimic {
    std::string joint;
    double multiplier = 1, offset = 0;
};

struct JointTags {
    int line = 0; ///< of <joint>, 1-based
    bool limited = false;
    std::optional<Mimic> mimic;
};

/// By the joints' names. Empty if the source is not a URDF. Throws Error(input) for a <mimic> that is not understood.
std::map<std::string, JointTags> read_joint_tags(const Robot& robot);

} // namespace foam
