// visualization_msgs/MarkerArray as YAML: what `ros2 topic pub` takes and `ros2 topic echo` prints.
#pragma once

#include <foam/sdk/model.hpp>

#include <string>
#include <string_view>

namespace foam::scene {

/// Returns the message: a marker a sphere, in the frame of its link.
std::string markers_text(const SphereModel& model, double alpha);

/// Returns whether the first outermost key of a YAML text is `markers`, with frames.
bool is_markers(std::string_view text);
/// Returns the spheres by frame. Throws Error(input) naming file, place and reason.
SphereFile read_markers(const std::string& text, const std::filesystem::path& file);

} // namespace foam::scene
