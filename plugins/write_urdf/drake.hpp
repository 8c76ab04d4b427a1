// What Drake reads of a URDF beyond other programs: pairs of links that need no check, and properties of contact.
// Parsing: RobotLocomotion/drake 018bf81c12, multibody/parsing/detail_urdf_geometry.cc; 007f5fc932, detail_common.cc.
#pragma once

#include "sphere_urdf.hpp"

namespace foam {

/// Declares Drake's namespace in the <robot>, if it is not there.
void declare_drake(SphereUrdf& urdf);
/// Adds a group for each link of an ignored pair, with the groups that it ignores.
void add_collision_filter_groups(SphereUrdf& urdf, Context& context);
/// Returns <drake:proximity_properties>; empty if both are 0.
std::string proximity_properties(double mu_static, double mesh_resolution_hint);

} // namespace foam
