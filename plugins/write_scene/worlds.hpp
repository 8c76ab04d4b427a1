// Worlds of planners: obstacles as cuRobo's scene files and VAMP's problems have them. Objects stand at their own
// frame's origin; robots are refused.
#pragma once

#include <foam/sdk/elements.hpp>

#include <string>
#include <string_view>

namespace foam::scene {

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
