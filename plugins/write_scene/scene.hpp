// The .scene files of MoveIt: objects of the world as text.
#pragma once

#include <foam/sdk/model.hpp>

#include <string>
#include <string_view>

namespace foam::scene {

/// Returns the file of a model: an object a link. Throws Error(output) for a name that the format cannot hold.
std::string scene_text(const SphereModel& model, bool old_format);

/// Returns whether a text begins as a scene does: a name, a line "* OBJECT", a line of numbers.
bool is_scene(std::string_view text);
/// Returns the spheres by object, each in its object's frame. Throws Error(input) naming file, line and reason.
SphereFile read_scene(std::string_view text, const std::filesystem::path& file);

} // namespace foam::scene
