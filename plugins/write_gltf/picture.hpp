// glTF files with the spheres of a model, to look at.
#pragma once

#include <foam/sdk/model.hpp>

#include <string>
#include <string_view>

namespace foam::gltf {

/// Returns the file: the links at the default pose, each with its spheres as children. Throws Error(output) for a name
/// that JSON cannot hold.
std::string picture_text(const SphereModel& model);

/// Returns whether a text begins as the file of picture_text() does.
bool is_picture(std::string_view text);
/// Returns the spheres by link of such a file, in link frames. Throws Error(input) naming file, place and reason.
SphereFile read_picture(const std::string& text, const std::filesystem::path& file);

} // namespace foam::gltf
