// The named poses of an SRDF or an MJCF.
#pragma once

#include <foam/robot/robot.hpp>

#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] robot {

/// A pose with a name, of some joints of a robot: a <group_state>, or a <key>.
struct GroupState {
    std::string name;
    JointValues values; ///< rad or m
};

/// Returns the <group_state> elements of an SRDF, or the keyframes of an MJCF, in their order, without joints of several
/// freedoms; nothing for a text of another format. Throws Error(input) naming file and line for a joint without a name or a position.
std::vector<GroupState> group_states(const std::string& text, const std::string& file);

} // namespace robot
} // namespace foam
