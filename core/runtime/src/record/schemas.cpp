#include <foam/runtime/schemas.hpp>

#include "record/embedded_schemas.hpp"

#include <algorithm>
#include <utility>

namespace foam::inline runtime {
namespace {

using namespace schema_files;

constexpr std::pair<const char*, const EmbeddedText*> files[] = {
    {"manifest", &manifest_schema_json},
    {"spheres", &spheres_schema_json},
    {"approximate", &approximate_schema_json},
    {"batch", &batch_schema_json},
    {"cache", &cache_schema_json},
    {"certify", &certify_schema_json},
    {"check", &check_schema_json},
    {"compare", &compare_schema_json},
    {"describe", &describe_schema_json},
    {"evaluate", &evaluate_schema_json},
    {"formats", &formats_schema_json},
    {"info", &info_schema_json},
    {"plan", &plan_schema_json},
    {"plugins", &plugins_schema_json},
    {"run", &run_schema_json},
    {"schema", &schema_schema_json},
    {"self-collision", &self_collision_schema_json},
    {"spherize", &spherize_schema_json},
    {"stages", &stages_schema_json},
    {"verify", &verify_schema_json},
    {"version", &version_schema_json},
};

} // namespace

std::vector<std::string> schema_names() {
    std::vector<std::string> names;
    for (const auto& [name, file] : files) {
        names.emplace_back(name);
    }
    return names;
}

std::string schema_named(const std::string& name) {
    const auto* found = std::find_if(std::begin(files), std::end(files), [&](const auto& file) { return file.first == name; });
    return found == std::end(files) ? std::string() : std::string(found->second->text);
}

} // namespace foam::runtime
