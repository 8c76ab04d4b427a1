#include <foam/runtime/schemas.hpp>

#include "embedded_schemas.hpp"

namespace foam::inline runtime {

std::string manifest_schema() {
    return std::string(schema_files::manifest_schema_json.text);
}

std::string spheres_schema() {
    return std::string(schema_files::spheres_schema_json.text);
}

} // namespace foam::runtime
