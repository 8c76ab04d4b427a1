// JSON Schemas (draft 2020-12) of what a run writes; that of recipes is recipe_schema().
#pragma once

#include <string>

namespace foam {

/// Of manifest.json.
std::string manifest_schema();
/// Of the sphere database that write.json writes in its layout "links".
std::string spheres_schema();

} // namespace foam
