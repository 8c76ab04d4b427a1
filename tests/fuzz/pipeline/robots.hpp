// Random URDF files with the meshes that they refer to.
#pragma once

#include "dice.hpp"

#include <map>

namespace foam::fuzz {

struct RandomRobot {
    std::map<std::string, std::string> files;      ///< by name; "robot.urdf" is among them
    std::vector<std::string> links, moving_joints; ///< names as a reader has them
};

/// One to four links of primitives and small meshes, joined to one tree.
RandomRobot random_robot(Dice& dice, bool odd_numbers);

} // namespace foam::fuzz
