// The version of foam, and the schemas it holds.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

/// Returns the version, such as "0.2.0".
std::string version();
/// Returns the versions of the libraries that core computes with, by name; plugins report their own.
std::map<std::string, std::string> library_versions();

/// Returns "manifest" for manifest.json, "spheres" for the file that write.json writes in its layout "links", and the
/// names of the commands that print JSON.
std::vector<std::string> schema_names();
/// Returns the schema with one of these names; nothing for another name.
std::string schema_named(const std::string& name);

} // namespace runtime
} // namespace foam
