// The parts that several formats share: spheres of links, pairs, joints, as values of a YAML or JSON tree.
#pragma once

#include <foam/sdk/context.hpp>
#include <foam/sdk/planning.hpp>
#include <foam/yaml/write.hpp>

namespace foam::tree {

/// Returns {link: [{center: [x, y, z], radius: r}, …]}.
yaml::Value spheres_of_links(const std::vector<LinkSpheres>& links);
/// Returns {link: [other, …]} with each pair once, under its first link.
yaml::Value ignored_links(const std::vector<IgnoredPair>& pairs);
/// Returns the names of joints.
yaml::Value names_of(const PlannedJoints::Positions& joints);
/// Returns the positions of joints.
yaml::Value positions_of(const PlannedJoints::Positions& joints);
/// Returns {joint: position}.
yaml::Value map_of(const PlannedJoints::Positions& joints);
/// Returns a list with the same number for each joint.
yaml::Value repeated(double value, std::size_t count);

/// Returns the robot's URDF as a program finds it: its absolute path; without a folder the name of the file. For a
/// robot of no file the URDF is expected beside the file that is written. Logs a URDF that is not there.
std::string urdf_path(const SphereModel& model, Context& context);

/// Throws Error(output) for a link with spheres that is not below the base link: a program would not find it.
void require_below_base(const SphereModel& model, const std::vector<LinkSpheres>& links, const std::string& writer);

} // namespace foam::tree
