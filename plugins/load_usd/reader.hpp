// Robots in USD: the package usd-core composes the stage, in a Python of its own.
#pragma once

#include <foam/robot/robot.hpp>
#include <foam/sdk/stage.hpp>

#include <filesystem>

namespace foam::load_usd {

/// Returns the robot of a stage's file. Throws Error(input) with the reason if the file cannot be used, and Error(plugin)
/// with the remedy where no Python with usd-core is found.
Robot robot_of(const std::filesystem::path& file, Context& context);

} // namespace foam::load_usd
