// The robot of an SDF text.
#pragma once

#include <foam/robot/robot.hpp>
#include <foam/sdk/context.hpp>
#include <foam/sdk/resource.hpp>
#include <foam/sdk/stage.hpp>

#include <filesystem>
#include <string>

namespace foam::load_sdf {

/// Returns the robot: every model of the text, with those that it includes. The root link is that of the only tree, or
/// "world". Throws Error(input) naming file and line; Error(plugin) where foam was built without libsdformat.
/// `meshes`: reads those that collide as their hull; null: there is none.
Robot robot_of(const std::string& text, const std::filesystem::path& file, const ResourceResolver& resources,
               const MeshLoader* meshes, Context& context);

} // namespace foam::load_sdf
