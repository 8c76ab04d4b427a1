// The figures of every link.
#include "sections.hpp"

#include <foam/report/html_page.hpp>

#include <fmt/format.h>

#include <cmath>

namespace foam::inline report {
namespace {

constexpr int columns = 11;

std::vector<double> values_of(const Json& links, const char* figure) {
    std::vector<double> values;
    for (const Json& link : links) {
        if (link.contains("measures")) {
            values.push_back(value_of(link["measures"][figure]));
        }
    }
    return values;
}

/// A figure of the table with bars.
struct BarColumn {
    const char* figure;
    const char* name; ///< in the table's header
    double unit;      ///< of the table, in the manifest's unit
    double least;     ///< figures that read 0 in the table need no bar
};

constexpr BarColumn bar_columns[] = {{"excess", "excess", 1, 5e-4},
                                     {"missing", "missing", 1, 5e-4},
                                     {"gap_m", "gap", 1e-3, 5e-7},
                                     {"protrusion_max_m", "out max", 1e-3, 5e-5}};

class LinkTable {
public:
    explicit LinkTable(const Json& manifest) : manifest_(manifest) {
        for (const BarColumn& column : bar_columns) {
            scales_.emplace(column.figure, BarScale(values_of(manifest["links"], column.figure), column.least));
        }
    }

    /// Returns the explanation of the bars.
    std::string note() const {
        std::string logarithmic;
        for (const BarColumn& column : bar_columns) {
            if (const BarScale& scale = scales_.at(column.figure); scale.logarithmic()) {
                logarithmic += fmt::format("{} {} from {:.3g} to {:.3g}", logarithmic.empty() ? "" : ",", column.name,
                                           scale.lowest() / column.unit, scale.greatest() / column.unit);
            }
        }
        return "Bars compare the links within a column" +
               (logarithmic.empty() ? "." : ", on a logarithmic scale where values span decades:" + logarithmic + ".");
    }

    std::string html() const {
        std::string rows;
        for (const Json& link : manifest_["links"]) {
            rows += link.contains("measures") ? row(link) : empty_row(link);
        }
        const Json& total = manifest_["total"];
        return fmt::format(
            "<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"Figures of every link\">"
            "<table class=\"sortable\">\n<thead><tr><th scope=\"col\">link</th><th scope=\"col\">spheres</th>"
            "<th scope=\"col\">excess</th><th scope=\"col\">missing</th><th scope=\"col\">gap mm</th>"
            "<th scope=\"col\">certified</th><th scope=\"col\">covered %</th><th scope=\"col\">out max mm</th>"
            "<th scope=\"col\">out mean mm</th><th scope=\"col\">growth mm</th><th scope=\"col\">visual gap "
            "mm</th></tr></thead>\n<tbody>\n{}</tbody>\n"
            "<tfoot><tr><th scope=\"row\">total</th>{}<td></td><td></td></tr></tfoot>\n</table></div>\n",
            rows, figures(total, false));
    }

private:
    std::string row(const Json& link) const {
        const double growth = mm_per_m * value_of(link["growth_m"]);
        return fmt::format("<tr data-link=\"{0}\"><th scope=\"row\">{0}</th>{1}{2}{3}</tr>\n", escaped(link["link"]),
                           figures(link["measures"], true), cell(growth, number(growth, 3)), visual_gap_cell(link));
    }

    static std::string visual_gap_cell(const Json& link) {
        if (!link.contains("visual_gap_m")) {
            return link.contains("visual_gap_unknown") ? "<td>not known</td>" : "<td></td>";
        }
        const double gap = mm_per_m * value_of(link["visual_gap_m"]);
        return cell(gap, number(gap, 3));
    }

    static std::string empty_row(const Json& link) {
        const std::string why = link.contains("error") ? escaped(link["error"]) : "excluded by the recipe";
        return fmt::format("<tr><th scope=\"row\">{}</th><td class=\"why\" colspan=\"{}\">{}</td></tr>\n",
                           escaped(link["link"]), columns - 1, why);
    }

    std::string figures(const Json& m, bool bars) const {
        const auto estimate = [&](const std::string& figure) {
            const double value = value_of(m[figure]), error = value_of(m[figure + "_standard_error"]);
            const std::string text =
                number(value, 3) +
                (error > 0 && std::isfinite(error) ? fmt::format(" <small>± {}</small>", number(error, 3)) : "");
            return figure_cell(figure, value, text, bars);
        };
        const auto length = [&](const char* figure, int digits) {
            const double mm = mm_per_m * value_of(m[figure]);
            return figure_cell(figure, mm / mm_per_m, number(mm, digits), bars);
        };
        const double covered = 100 * value_of(m["covered"]), mean = mm_per_m * value_of(m["protrusion_mean_m"]);
        const auto spheres = m["spheres"].get<std::size_t>();
        return cell(static_cast<double>(spheres), fmt::format("{}", spheres)) + estimate("excess") +
               estimate("missing") + length("gap_m", 3) + yes_no_cell(m["certified"].get<bool>()) +
               cell(covered, number(covered, 2)) + length("protrusion_max_m", 1) + cell(mean, number(mean, 1));
    }

    std::string figure_cell(const std::string& figure, double value, const std::string& text, bool bar) const {
        return cell(value, bar ? text + scales_.at(figure).svg(value) : text);
    }

    const Json& manifest_;
    std::map<std::string, BarScale> scales_;
};

} // namespace

/// Returns the list of how far spheres extend beyond planes of half-space constraints.
static std::string planes_list(const Json& manifest) {
    std::string items;
    for (const Json& link : manifest["links"]) {
        for (const Json& plane : link.value("clip", Json::array())) {
            const Json& n = plane["normal"];
            items += fmt::format(
                "<li><strong>{}</strong>: {} mm beyond the plane with normal [{}, {}, {}] at {} mm, {} mm allowed: "
                "{}</li>\n",
                escaped(link["link"]), number(mm_per_m * value_of(plane["reached_m"]), 3), value_of(n[0]),
                value_of(n[1]), value_of(n[2]), number(mm_per_m * value_of(plane["offset_m"]), 3),
                number(mm_per_m * value_of(plane["reach_m"]), 3),
                plane["kept"].get<bool>() ? "kept" : "<strong class=\"no\">not kept</strong>");
        }
    }
    return items.empty() ? ""
                         : "<p>Half-space constraints, and how far the spheres extend beyond the planes:</p>\n<ul>\n" +
                               items + "</ul>\n";
}

/// Returns why the gap to the visual geometry of links is not known.
static std::string unknown_gaps_list(const Json& manifest) {
    std::string items;
    for (const Json& link : manifest["links"]) {
        if (link.contains("visual_gap_unknown")) {
            items += fmt::format("<li>{}</li>\n", escaped(link["visual_gap_unknown"]));
        }
    }
    return items.empty() ? "" : "<p>Visual geometry that could not be read:</p>\n<ul>\n" + items + "</ul>\n";
}

/// Returns a sentence about links whose insides count as geometry.
static std::string filled_text(const Json& manifest) {
    std::string names;
    for (const Json& link : manifest["links"]) {
        if (link.contains("filled_volume_m3")) {
            names += (names.empty() ? "" : ", ") + escaped(link["link"]);
        }
    }
    return names.empty() ? ""
                         : fmt::format("<p>Hollow insides that count as geometry in these figures: {}.</p>\n", names);
}

/// Returns a sentence about the padding and the excess without it.
static std::string padding_text(const Json& manifest) {
    const Json& total = manifest["total"];
    return total.contains("excess_unpadded")
               ? fmt::format("<p>The recipe pads links. Total excess before the padding: {}, after it: {}.</p>\n",
                             number(value_of(total["excess_unpadded"]), 3), number(value_of(total["excess"]), 3))
               : "";
}

std::string links_section(const Report& report) {
    const LinkTable table(report.manifest);
    return section("links", "Links",
                   table.html() + "<p class=\"note\">" + table.note() +
                       " Out: how far the spheres extend beyond the geometry. Growth: the largest length by which the "
                       "radius of a sphere of the spherizer was enlarged for the guarantee. Visual gap: how far the "
                       "visual geometry extends beyond the spheres, where it is not to be covered.</p>\n" +
                       unknown_gaps_list(report.manifest) + filled_text(report.manifest) +
                       padding_text(report.manifest) + planes_list(report.manifest));
}

} // namespace foam::report
