// Links by their names.
#pragma once

#include <foam/robot/robot.hpp>

#include <cstddef>
#include <string>

namespace foam::inline view {

/// Returns the index of a link. Precondition: the robot has it.
inline std::size_t link_index(const Robot& robot, const std::string& link) {
    return static_cast<std::size_t>(robot.find_link(link) - robot.links.data());
}

} // namespace foam::inline view
