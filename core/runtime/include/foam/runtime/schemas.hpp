// JSON Schemas (draft 2020-12) of the output of a run; that of recipes is recipe_schema().
#pragma once

#include <string>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

/// Returns the schema of manifest.json.
std::string manifest_schema();
/// Returns the schema of the sphere database that write.json writes in its layout "links".
std::string spheres_schema();

} // namespace runtime
} // namespace foam
