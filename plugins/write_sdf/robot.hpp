// The SDF of a robot that was read from another format.
#pragma once

#include <foam/sdk/context.hpp>
#include <foam/sdk/elements.hpp>

#include <string>

namespace foam::sdf {

/// Returns the file of a robot: links with their masses, visual geometry and elements, and joints. Links stand where
/// their joints put them at zero. Mesh files are named from the folder of the output. What SDF 1.9 has not is said: joints
/// that follow others, masses that Gazebo would guess, visual meshes that no file holds. Throws Error(output) for names
/// that SDF refuses, and for planar joints.
std::string robot_text(const SphereModel& model, const KnownKinds& known, Context& context);

} // namespace foam::sdf
