// SDF files of objects, as Gazebo reads them.
#pragma once

#include <foam/sdk/elements.hpp>

#include <functional>
#include <string>
#include <string_view>

namespace foam::sdf {

/// Returns the file of a model with one link. Throws Error(output) for other models, and for names that SDF refuses.
/// Hulls are meshes beside it, of hull_files().
std::string object_text(const SphereModel& model, bool is_static, const KnownKinds& known);
/// Throws Error(output) for a name that sdformat takes for another or refuses. `what`: "link", "joint" or "model".
void require_name(const std::string& name, std::string_view what);
/// Returns a comment line of where the file is from; empty for an empty text.
std::string provenance_comment(std::string_view provenance);
/// Returns the name of the file that is written, or one after the model where it is not known.
std::string file_name_of(const SphereModel& model);

/// Returns whether an XML text has the root element <sdf>.
bool is_sdf(std::string_view text);
/// Returns the text of a mesh of a hull by its URI; empty for any other.
using MeshText = std::function<std::string(const std::string& uri)>;
/// Returns the elements of all links of all models, in link frames. `own`: those that foam wrote alone; it places none
/// in another frame. Throws Error(input) naming file, line and reason.
SphereFile read_sdf(const std::string& text, const std::filesystem::path& file, const MeshText& mesh_text,
                    bool own = false);

} // namespace foam::sdf
