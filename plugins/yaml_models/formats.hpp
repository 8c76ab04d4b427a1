// The formats of sphere models in YAML and JSON: each function reads a whole tree.
#pragma once

#include "tree.hpp"

namespace foam::tree {

/// Reads the JSON of write.json.
void read_foam_json(const yaml::Value& root, Tree& tree);
/// Reads XRDF 1.0 (`collision`) and 2.0 (`world_collision`),
/// https://nvidia-isaac-ros.github.io/concepts/manipulation/xrdf.html
void read_xrdf(const yaml::Value& root, Tree& tree);
/// Reads a robot file of cuRobo, whose spheres are in `kinematics`.
void read_curobo(const yaml::Value& root, Tree& tree);
/// Reads `collision_spheres` of bubblify and cuRobo's sphere files: a map of lists; plainmp: a map of maps; Lula: a
/// list of maps.
void read_collision_spheres(const yaml::Value& root, Tree& tree);
/// Reads `{centers, radii}` for a single body (MorphIt), or by link (ballpark, pyroki).
void read_columns(const yaml::Value& root, Tree& tree);
/// Reads `spheres: {link: […]}`.
void read_spheres_by_link(const yaml::Value& root, Tree& tree);
/// Reads the output of CoMMALab/foam (Coumar et al. 2025): a list by depth for a mesh, a database for a robot.
void read_commalab(const yaml::Value& root, Tree& tree);

} // namespace foam::tree
