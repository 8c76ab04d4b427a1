#include <foam/base/internal/activity.hpp>
#include <foam/runtime/version.hpp>

#include <Eigen/Core>
#include <fmt/format.h>
#include <gnu/libc-version.h>
#include <nlohmann/json.hpp>
#include <xxhash.h>

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

} // namespace foam::runtime
