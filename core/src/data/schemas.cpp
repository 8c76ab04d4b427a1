#include <foam/host/schemas.hpp>

#include "embedded_text.hpp"

namespace foam {

std::string manifest_schema() {
    return std::string(embedded::manifest_schema_json.text);
}

std::string spheres_schema() {
    return std::string(embedded::spheres_schema_json.text);
}

} // namespace foam
