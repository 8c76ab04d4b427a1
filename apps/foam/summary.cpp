#include "execute.hpp"

#include "commands.hpp"

#include <foam/base/text.hpp>
#include <foam/runtime/run_json.hpp>
#include <foam/sdk/kinds.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace foam::cli {
namespace {

constexpr double mm_per_m = 1000;

/// Which columns a table of links has.
struct Columns {
    std::size_t name = 0; ///< width
    int count = 7;        ///< width
    bool excess = true, missing = false;
};

std::string row(const std::string& name, const Columns& columns, const Measures& m, const std::string& growth) {
    return fmt::format("{}  {:>{}}{}{}  {:>8}  {:>9}  {:>9}\n", padded(name, columns.name), m.spheres, columns.count,
                       columns.excess ? fmt::format("  {:>8}", figure_text(m.excess, 3)) : "",
                       columns.missing ? fmt::format("  {:>8}", figure_text(m.missing, 3)) : "",
                       figure_text(m.gap * mm_per_m, 3), m.certified ? "yes" : "no", growth);
}

/// Spheres inside the geometry have no excess; volume that is missing is shown wherever there is some.
Columns columns_of(const RunResult& result, Guarantee guarantee, bool spheres) {
    const bool inner = guarantee == Guarantee::inner;
    const bool missing = std::any_of(result.links.begin(), result.links.end(),
                                     [](const LinkReport& link) { return link.measures.missing > 0; });
    return {.name = column_width("total", result.links, &LinkReport::link),
            .count = spheres ? 7 : 8,
            .excess = !inner,
            .missing = inner || missing};
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
    std::string table = filter_table(result);
    KindCounts kinds{};
    for (const LinkReport& link : result.links) {
        kinds = sum_of(kinds, link.kinds);
    }
    const bool spheres = spheres_alone(kinds);
    const Columns columns = columns_of(result, guarantee, spheres);
    table += fmt::format("{:<{}}  {:>{}}{}{}  {:>8}  {:>9}  {:>9}\n", "link", columns.name,
                         spheres ? "spheres" : "elements", columns.count, columns.excess ? "    excess" : "",
                         columns.missing ? "   missing" : "", "gap mm", "certified", "growth mm");
    for (const LinkReport& link : result.links) {
        if (link.skipped) {
            table += padded(link.link, columns.name) + "  excluded by the recipe\n";
        } else if (!link.error.empty() && link.measures.spheres == 0) {
            table += fmt::format("{}  failed: {}\n", padded(link.link, columns.name), shown(link.error));
        } else {
            table += row(link.link, columns, link.measures, figure_text(link.growth * mm_per_m, 3));
        }
    }
    table += row("total", columns, result.total, "");
    if (!spheres) {
        table += fmt::format("Elements: {}.\n", counts_text(kinds));
    }
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
    return table + verdict_of(result.proved) + omissions_of(result.proved);
}

} // namespace foam::cli
