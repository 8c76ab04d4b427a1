// What options say of a robot: the same for every command, and for Python.
#pragma once

#include <foam/robot/robot.hpp>

#include <string>
#include <utility>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] recipe {

/// Links by globs, joints and links by name.
struct RobotChoices {
    std::vector<std::string> keep{}; ///< links that are worked on; none: all
    std::vector<std::string> skip{}; ///< of these, links that get no elements and keep their geometry
    std::vector<std::pair<std::string, double>> weights{}; ///< of links; the last that matches counts
    JointValues locks{};                                   ///< joints that stand still; rad or m
    std::vector<std::string> tool_frames{};                ///< links

    bool operator==(const RobotChoices&) const = default;
};

/// Returns whether the link is worked on.
bool is_chosen(const RobotChoices& choices, const std::string& link);

/// Checks the choices against the robot. Throws Error(usage), with the nearest name, for a glob that matches no link
/// and for a tool frame that is none. Throws it also for globs that leave no link, and for a joint that cannot be held.
/// `dashes`: before the name of an option in messages.
void require_choices(const RobotChoices& choices, const Robot& robot, const char* dashes = "--");

/// Throws Error(usage) for a factor that is no weight: above 0, at most 1000000. `text`: what was given.
void require_weight(double weight, const std::string& text, const char* dashes = "--");

} // namespace recipe
} // namespace foam
