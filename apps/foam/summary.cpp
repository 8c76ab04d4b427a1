#include "summary.hpp"

#include "table.hpp"

#include <foam/base/text.hpp>
#include <foam/geometry/measure_names.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace foam::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr double mm_per_m = 1000;

std::string row(const std::string& name, std::size_t width, const Measures& m, Guarantee guarantee,
                const std::string& growth) {
    return fmt::format("{}  {:>7}  {:>8}  {:>8}  {:>9}  {:>9}\n", padded(name, width), m.spheres,
                       figure_text(guarantee == Guarantee::inner ? m.missing : m.excess, 3),
                       figure_text(m.gap * mm_per_m, 3),
                       m.certified ? "yes" : "no", growth);
}

Json json_of_size(const InputSize& size) {
    const Vec3 edges = size.box.size();
    return {{"size_m", {edges.x, edges.y, edges.z}}, {"links", size.links}, {"triangles", size.triangles}};
}

Json json_of_reach(const PlaneReach& reach) {
    const ClipPlane& plane = reach.plane;
    return {{"normal", {plane.normal.x, plane.normal.y, plane.normal.z}},
            {"offset_m", plane.offset},
            {"reach_m", plane.reach},
            {"reached_m", reach.reached},
            {"kept", reach.kept()}};
}

const char* to_string(Severity severity) {
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

void add(FilterTotal& total, const MeshChange& change) {
    const double volume = change.volume_change().value_or(0);
    ++total.meshes;
    total.before += change.triangles_before;
    total.after += change.triangles_after;
    total.distance = std::max(total.distance, change.distance());
    total.volume_change = std::abs(volume) > std::abs(total.volume_change) ? volume : total.volume_change;
}

/// In the order in which the stages first come.
std::vector<FilterTotal> filters_of(const RunResult& result) {
    std::vector<FilterTotal> totals;
    for (const LinkReport& link : result.links) {
        for (const StageReport& stage : link.stages) {
            if (stage.change) {
                auto total = std::find_if(totals.begin(), totals.end(),
                                          [&](const FilterTotal& t) { return t.stage == stage.stage; });
                add(total == totals.end() ? totals.emplace_back(FilterTotal{.stage = stage.stage}) : *total,
                    *stage.change);
            }
        }
    }
    return totals;
}

std::string filter_table(const RunResult& result) {
    const std::vector<FilterTotal> totals = filters_of(result);
    if (totals.empty()) {
        return {};
    }
    const std::size_t width = column_width("filter", totals, &FilterTotal::stage);
    std::string table = fmt::format("{:<{}}  {:>6}  {:>20}  {:>11}  {:>8}\n", "filter", width, "meshes", "triangles",
                                    "distance mm", "volume %");
    for (const FilterTotal& total : totals) {
        table += fmt::format("{:<{}}  {:>6}  {:>8} to {:>8}  {:>11.3f}  {:>8.2f}\n", total.stage, width, total.meshes,
                             total.before, total.after, total.distance * mm_per_m, 100 * total.volume_change);
    }
    return table + "\n";
}

/// Returns a sentence about the padding and the excess without it.
std::string padding_text(const RunResult& result) {
    double least = 0, most = 0;
    std::size_t links = 0;
    for (const LinkReport& link : result.links) {
        if (link.unpadded) {
            least = links == 0 ? link.pad : std::min(least, link.pad);
            most = std::max(most, link.pad);
            ++links;
        }
    }
    const std::string length =
        least == most ? figure_text(most * mm_per_m, 3)
                      : fmt::format("{} to {}", figure_text(least * mm_per_m, 3), figure_text(most * mm_per_m, 3));
    return fmt::format("Padding of {} link{}: {} mm; total excess {} before, {} after.\n", links, links == 1 ? "" : "s",
                       length, figure_text(result.total_unpadded->excess, 3), figure_text(result.total.excess, 3));
}

} // namespace

std::string table_of(const RunResult& result, Guarantee guarantee) {
    const std::size_t width = column_width("total", result.links, &LinkReport::link);
    std::string table = filter_table(result);
    table += fmt::format("{:<{}}  {:>7}  {:>8}  {:>8}  {:>9}  {:>9}\n", "link", width, "spheres",
                         guarantee == Guarantee::inner ? "missing" : "excess", "gap mm", "certified", "growth mm");
    for (const LinkReport& link : result.links) {
        if (link.skipped) {
            table += padded(link.link, width) + "  excluded by the recipe\n";
        } else if (!link.error.empty() && link.measures.spheres == 0) {
            table += fmt::format("{}  failed: {}\n", padded(link.link, width), shown(link.error));
        } else {
            table += row(link.link, width, link.measures, guarantee, figure_text(link.growth * mm_per_m, 3));
        }
    }
    table += row("total", width, result.total, guarantee, "");
    if (const auto filled = std::count_if(result.links.begin(), result.links.end(),
                                          [](const LinkReport& link) { return link.filled > 0; });
        filled > 0) {
        table += fmt::format("The insides of {} hollow link{} count as geometry in these figures.\n", filled,
                             filled == 1 ? "" : "s");
    }
    if (result.total_unpadded) {
        table += padding_text(result);
    }
    for (const LinkReport& link : result.links) {
        for (const PlaneReach& plane : link.clip) {
            table += fmt::format("{}: {:.3f} mm beyond the plane with {}: {}, {} mm allowed\n", shown(link.link),
                                 plane.reached * mm_per_m, text_of(plane.plane), plane.kept() ? "kept" : "NOT KEPT",
                                 plane.plane.reach * mm_per_m);
        }
    }
    table += verdict_of(result.proved) + omissions_of(result.proved);
    return table;
}

Json json_of(const RunResult& result, const Recipe& recipe, const std::filesystem::path& directory) {
    Json json{{"name", recipe.name},
              {"input", result.input},
              {"input_file", result.input_file.string()},
              {"input_size", json_of_size(result.input_size)},
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
        for (const PlaneReach& plane : link.clip) {
            entry["clip"].push_back(json_of_reach(plane));
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
        json["findings"].push_back({{"severity", to_string(finding.severity)},
                                    {"link", finding.link},
                                    {"stage", finding.stage},
                                    {"message", finding.message}});
    }
    return json;
}

} // namespace foam::cli
