// The formats of sphere models, all read into a SphereFile.
#pragma once

#include <foam/judge/sphere_file.hpp>

#include <string>

namespace foam::inline judge::model_formats {

/// Reads JSON and YAML; their keys determine the format.
void read_tree(const std::string& text, SphereFile& result);
/// Reads rows of four numbers (x y z radius) or five (link x y z radius), separated by spaces or commas.
void read_rows(const std::string& text, SphereFile& result);
void read_urdf(const std::string& text, const Registry& registry, SphereFile& result);
/// Reads the file of a writer in the registry: the one for the extension `extension`.
void read_written(const std::string& text, const std::string& extension, const Registry& registry, SphereFile& result);

/// Returns the spheres of a link; adds the link if it is missing.
std::vector<Sphere>& spheres_of(SphereFile& result, const std::string& link);

} // namespace foam::judge::model_formats
