// SDF files of objects, as Gazebo reads them.
#pragma once

#include <foam/sdk/model.hpp>

#include <string>
#include <string_view>

namespace foam::sdf {

/// Returns the file of a model with one link. Throws Error(output) for other models, and for names that SDF refuses.
std::string object_text(const SphereModel& model, bool is_static);

/// Returns whether an XML text has the root element <sdf>.
bool is_sdf(std::string_view text);
/// Returns the spheres of all links of all models, in link frames. Throws Error(input) naming file, line and reason.
SphereFile read_sdf(const std::string& text, const std::filesystem::path& file);

} // namespace foam::sdf
