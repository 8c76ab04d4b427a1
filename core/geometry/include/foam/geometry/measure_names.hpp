// The names of figures in all output for programs: JSON of all commands, manifests, sphere files.
#pragma once

#include <foam/geometry/measure.hpp>

#include <utility>
#include <variant>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

using NamedFigure = std::pair<const char*, std::variant<std::size_t, double, bool>>;

/// Returns the figures of a link or of the whole under their names, which end in the unit; ratios have none. A figure
/// that is infinite is null in JSON.
std::vector<NamedFigure> named_figures(const Measures& measures);

/// Returns a JSON object, of a class such as nlohmann's, of named_figures().
template <class Json> Json json_of_measures(const Measures& measures) {
    Json json = Json::object();
    for (const auto& [name, value] : named_figures(measures)) {
        std::visit([&json, key = name](const auto& figure) { json[key] = figure; }, value);
    }
    return json;
}

} // namespace geometry
} // namespace foam
