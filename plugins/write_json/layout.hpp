// The layouts of a model in JSON.
#pragma once

#include <foam/base/text.hpp>
#include <foam/sdk/model.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <map>
#include <string>
#include <vector>

namespace foam {

using Json = nlohmann::ordered_json; // keeps the order of a link's groups
using ElementsByLink = std::map<std::string, Elements>;

/// Returns foam's layout: schemas/spheres.schema.json. Version 2 where there are elements other than spheres.
std::string write_links_layout(const SphereModel& model);
ElementsByLink read_links_layout(const Json& document);

/// Throws Error(output) for elements other than spheres, which the layouts of CoMMALab/foam do not hold.
void require_spheres(const SphereModel& model);
/// Returns the database layout of Coumar et al. 2025: {"link::mesh": {"<branch>": {"<depth>": {mean, best, worst,
/// spheres}}}}.
std::string write_original_layout(const SphereModel& model);
/// Returns the same for a single mesh: a list of {mean, best, worst, spheres, link}, one for each depth. Throws
/// Error(output) if the model has more than one group.
std::string write_original_mesh_layout(const SphereModel& model);
/// Reads both of these layouts.
ElementsByLink read_original_layout(const Json& document);

/// Returns a JSON string; bytes that are not UTF-8 become U+FFFD.
inline std::string json_text(const std::string& text) {
    return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Returns a JSON number. JSON has no infinity and no NaN: null stands for what could not be measured.
inline std::string json_number(double value) {
    return std::isfinite(value) ? number_text(value) : "null";
}

inline std::string json_point(const Vec3& point) {
    return fmt::format("[{}, {}, {}]", number_text(point.x), number_text(point.y), number_text(point.z));
}

} // namespace foam
