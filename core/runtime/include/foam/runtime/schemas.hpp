// JSON Schemas (draft 2020-12) of the files of a run and of what commands print; that of recipes is recipe_schema().
#pragma once

#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

/// Returns "manifest" for manifest.json, "spheres" for the file that write.json writes in its layout "links", and the
/// names of the commands that print JSON.
std::vector<std::string> schema_names();
/// Returns the schema with one of these names; nothing for another name.
std::string schema_named(const std::string& name);

} // namespace runtime
} // namespace foam
