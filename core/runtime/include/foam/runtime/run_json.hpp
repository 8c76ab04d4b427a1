// The summary of a run as a JSON object, of a class such as nlohmann's.
#pragma once

#include <foam/geometry/measure.hpp>
#include <foam/runtime/run.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

template <class Json> Json json_of_size(const InputSize& size) {
    const Vec3 edges = size.box.size();
    return {{"size_m", {edges.x, edges.y, edges.z}}, {"links", size.links}, {"triangles", size.triangles}};
}

template <class Json> Json json_of_reach(const PlaneReach& reach) {
    const ClipPlane& plane = reach.plane;
    return {{"normal", {plane.normal.x, plane.normal.y, plane.normal.z}},
            {"offset_m", plane.offset},
            {"reach_m", plane.reach},
            {"reached_m", reach.reached},
            {"kept", reach.kept()}};
}

inline const char* word_of(Severity severity) {
    constexpr const char* names[] = {"debug", "info", "warning", "error"};
    return names[static_cast<std::size_t>(severity)];
}

/// What the filters of one stage did to all meshes together.
struct FilterTotal {
    std::string stage;
    std::size_t meshes = 0, before = 0, after = 0;
    double distance = 0;      ///< m; the largest
    double volume_change = 0; ///< the largest in magnitude
};

inline void add_change(FilterTotal& total, const MeshChange& change) {
    const double volume = change.volume_change().value_or(0);
    ++total.meshes;
    total.before += change.triangles_before;
    total.after += change.triangles_after;
    total.distance = std::max(total.distance, change.distance());
    total.volume_change = std::abs(volume) > std::abs(total.volume_change) ? volume : total.volume_change;
}

/// Returns what the filters of a run did, in the order in which the stages first come.
inline std::vector<FilterTotal> filters_of(const RunResult& result) {
    std::vector<FilterTotal> totals;
    for (const LinkReport& link : result.links) {
        for (const StageReport& stage : link.stages) {
            if (stage.change) {
                auto total = std::find_if(totals.begin(), totals.end(),
                                          [&](const FilterTotal& t) { return t.stage == stage.stage; });
                add_change(total == totals.end() ? totals.emplace_back(FilterTotal{.stage = stage.stage}) : *total,
                           *stage.change);
            }
        }
    }
    return totals;
}

/// Returns the summary of a run. `directory`: of the run; may be empty.
template <class Json>
Json json_of_run(const RunResult& result, const Recipe& recipe, const std::filesystem::path& directory) {
    Json json{{"name", recipe.name},
              {"input", {{"taken", result.input}, {"file", result.input_file.string()}}},
              {"input_size", json_of_size<Json>(result.input_size)},
              {"directory", directory.string()},
              {"certified", result.certified},
              {"proof", json_of_proof<Json>(result.proved)},
              {"wall_seconds", result.seconds},
              {"cpu_seconds", result.cpu_seconds},
              {"total", json_of_measures<Json>(result.total)},
              {"links", Json::array()},
              {"filters", Json::array()},
              {"files", Json::array()},
              {"findings", Json::array()}};
    if (result.cut != Cut::none) {
        json["cut"] = to_string(result.cut);
    }
    for (const LinkReport& link : result.links) {
        Json entry{{"link", link.link}, {"skipped", link.skipped}, {"growth_m", link.growth}};
        entry.update(json_of_measures<Json>(link.measures));
        if (!spheres_alone(link.kinds)) {
            entry["kinds"] = json_of_kinds<Json>(link.kinds);
        }
        for (const PlaneReach& plane : link.clip) {
            entry["clip"].push_back(json_of_reach<Json>(plane));
        }
        if (!link.error.empty()) {
            entry["error"] = link.error;
        }
        json["links"].push_back(std::move(entry));
    }
    for (const FilterTotal& total : filters_of(result)) {
        json["filters"].push_back({{"stage", total.stage},
                                   {"meshes", total.meshes},
                                   {"triangles_before", total.before},
                                   {"triangles_after", total.after},
                                   {"distance_m", total.distance},
                                   {"volume_change", total.volume_change}});
    }
    for (const auto& file : result.files) {
        json["files"].push_back(file.string());
    }
    for (const Finding& finding : result.findings) {
        json["findings"].push_back({{"severity", word_of(finding.severity)},
                                    {"link", finding.link},
                                    {"stage", finding.stage},
                                    {"message", finding.message}});
    }
    return json;
}

} // namespace runtime
} // namespace foam
