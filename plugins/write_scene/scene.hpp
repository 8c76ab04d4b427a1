// Scenes and worlds of other programs, and markers.
#pragma once

#include <foam/geometry/vector.hpp>
#include <foam/sdk/elements.hpp>
#include <foam/sdk/model.hpp>

#include <array>
#include <string>
#include <string_view>

namespace foam::scene {

/// Returns the rotation as a unit quaternion x, y, z, w, with w >= 0.
std::array<double, 4> message_quaternion(const Pose& pose);

/// Returns the file of a model: an object a link. Throws Error(output) for a name that the format cannot hold.
std::string scene_text(const SphereModel& model, bool old_format);

/// Returns whether a text begins as a scene does: a name, a line "* OBJECT", a line of numbers.
bool is_scene(std::string_view text);
/// Returns the spheres by object, each in its object's frame. Throws Error(input) naming file, line and reason.
SphereFile read_scene(std::string_view text, const std::filesystem::path& file);

/// Returns the message: a marker a sphere, in the frame of its link.
std::string markers_text(const SphereModel& model, double alpha);

/// Returns whether the first outermost key of a YAML text is `markers`, with frames.
bool is_markers(std::string_view text);
/// Returns the spheres by frame. Throws Error(input) naming file, place and reason.
SphereFile read_markers(const std::string& text, const std::filesystem::path& file);

// Worlds of planners: obstacles as cuRobo's scene files and VAMP's problems have them. Objects stand at their own
// frame's origin; robots are refused.

/// Returns a scene of cuRobo: spheres, boxes as cuboids, and all else as meshes that enclose it. Of a capsule or
/// cylinder cuRobo would make a mesh whose corners lie on the surface, so that its triangles lie inside. Parsing:
/// NVlabs/curobo a35a708ecf, curobo/_src/geom/types.py.
std::string curobo_scene_text(const SphereModel& model, int segments);
/// Returns whether a YAML text has the keys of such a scene.
bool is_curobo_scene(std::string_view text);
SphereFile read_curobo_scene(const std::string& text, const std::filesystem::path& file);

/// Returns a problem of VAMP: spheres, boxes, and capsules, which are called cylinder there. A cylinder becomes the
/// capsule around it.
/// Parsing: KavrakiLab/vamp 3141841915, src/vamp/__init__.py: problem_dict_to_vamp; collision/factory.hh.
std::string vamp_world_text(const SphereModel& model);
/// Returns whether a JSON text has the keys of such a problem.
bool is_vamp_world(std::string_view text);
SphereFile read_vamp_world(const std::string& text, const std::filesystem::path& file);

} // namespace foam::scene
