// The formats of sphere models, each read into a SphereFile.
#pragma once

#include <foam/host/sphere_file.hpp>

#include <string>

namespace foam::model_formats {

/// JSON and YAML: recognised by their keys.
void read_tree(const std::string& text, SphereFile& result);
/// Rows of four numbers (x y z radius) or five (link x y z radius), apart by spaces or commas.
void read_rows(const std::string& text, SphereFile& result);
void read_urdf(const std::string& text, const Registry& registry, SphereFile& result);
/// What a writer of the registry has written: the one for files that end in `extension`.
void read_written(const std::string& text, const std::string& extension, const Registry& registry, SphereFile& result);

/// The spheres of a link, made if it is not there yet.
std::vector<Sphere>& spheres_of(SphereFile& result, const std::string& link);

} // namespace foam::model_formats
