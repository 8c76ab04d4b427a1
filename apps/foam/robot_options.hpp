// The options that commands with a robot share: one table, of which each command takes what has a meaning for it.
#pragma once

#include "cli/program.hpp"

#include <foam/recipe/quick_recipe.hpp>
#include <foam/recipe/robot_choices.hpp>
#include <foam/robot/robot.hpp>

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

namespace foam::cli {

enum class RobotOption { keep, skip, weight, lock, tool_frame, pad, geometry };

/// The texts of these options.
struct RobotOptions {
    std::vector<std::string> keep, skip, weights, locks, tool_frames;
    std::string pad, geometry = "collision";
};

/// Adds some of the options to a command.
void add_robot_options(CLI::App& command, RobotOptions& options, std::initializer_list<RobotOption> which);

/// Returns what the options choose. Throws Error(usage), naming the option, for a text that is not of its form, or that
/// contradicts another.
RobotChoices choices_of(const RobotOptions& options);
/// Returns --pad, at least 0; nothing if it is not given. Throws Error(usage).
std::optional<QuickLength> pad_of(const RobotOptions& options);
/// Returns the geometry that --geometry names.
CoveredGeometry covered_geometry(const std::string& word);

/// Returns the values of JOINT=NUMBER. Throws Error(usage), naming the option, for another text, and for a joint that is
/// named twice.
JointValues positions_of(const std::vector<std::string>& texts, const char* option);

/// Warns of a length without a unit that is larger than `of` ("the robot"), whose size is `size` in m. `option`: that it
/// was given to, "--pad".
void question_length(const std::string& option, const std::string& text, double size, std::string_view of);

} // namespace foam::cli
