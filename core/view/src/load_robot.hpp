// A robot or a mesh with everything that is drawn of it.
#pragma once

#include <foam/view/subject.hpp>

namespace foam::inline view {

/// Reads a URDF, or a mesh as a robot of one link. Adds to `notes` what is left out.
ViewedRobot load_robot(const std::filesystem::path& file, const SubjectOptions& options, const Registry& registry,
                       std::vector<std::string>& notes);
/// Returns a robot of which only the names of links are known.
ViewedRobot robot_of_names(const SphereFile& file);
/// Returns whether a robot has spheres, and nothing else, as its collision geometry.
bool is_sphere_model(const Robot& robot);
bool is_sphere(const GeometryElement& element);
/// Returns whether the file is read as a mesh.
bool is_mesh_file(const std::filesystem::path& file, const Registry& registry);

} // namespace foam::inline view
