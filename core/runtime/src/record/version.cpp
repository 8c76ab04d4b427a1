#include <foam/runtime/version.hpp>

#include "record/embedded_schemas.hpp"

#include <foam/base/internal/activity.hpp>

#include <Eigen/Core>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <xxhash.h>

#include <gnu/libc-version.h>

#include <algorithm>
#include <utility>

namespace foam::inline runtime {

std::string version() {
    return FOAM_VERSION;
}

std::map<std::string, std::string> library_versions() {
    const auto dotted = [](int major, int minor, int patch) { return fmt::format("{}.{}.{}", major, minor, patch); };
    const unsigned xxhash = XXH_versionNumber(); // major, minor, patch in two decimal digits each
    std::map<std::string, std::string> versions{
        {"eigen", dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
        {"fmt", dotted(FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
        {"glibc", gnu_get_libc_version()}, // for sine, power and other functions
        {"nlohmann-json",
         dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)},
        {"xxhash", dotted(static_cast<int>(xxhash / 10000), static_cast<int>(xxhash / 100 % 100),
                          static_cast<int>(xxhash % 100))},
        {"yaml-cpp", FOAM_YAML_CPP_VERSION},
    };
    if (const std::string onetbb = onetbb_version(); !onetbb.empty()) {
        versions.emplace("onetbb", onetbb);
    }
    return versions;
}

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

} // namespace foam::inline runtime
