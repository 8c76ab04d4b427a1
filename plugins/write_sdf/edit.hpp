// The SDF text of a robot with other collisions.
#pragma once

#include <foam/sdk/context.hpp>
#include <foam/sdk/elements.hpp>

#include <string>
#include <vector>

namespace foam::sdf {

/// Returns whether the robot was read from an SDF.
bool has_sdf_text(const SphereModel& model);

/// Returns that text with the elements of `links` in place of their collisions, and without those of
/// SphereModel::without_collision; every other byte stays, but for relative paths where the output is in another folder.
/// Planes, height maps, and collisions that touch nothing stay. New collisions have the settings of the old ones if
/// these agree. Throws Error(output) for a link of an included file.
std::string edited_sdf(const SphereModel& model, const std::vector<LinkSpheres>& links, Context& context);

} // namespace foam::sdf
