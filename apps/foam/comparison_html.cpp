// A comparison as one HTML file: no other file, no network.
#include "judge.hpp"

#include <foam/base/text.hpp>
#include <foam/report/html_page.hpp>
#include <foam/runtime/version.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace foam::cli {
namespace {

std::string number(double value, int digits) {
    return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "∞";
}

std::string certified(const ProvedLinks& verdict) {
    return fmt::format("<td class=\"{}\">{}</td>", verdict.all() ? "yes" : "no", certified_cell(verdict));
}

std::string total_table(const Comparison& comparison) {
    std::string html =
        "<div class=\"wide\"><table><thead><tr><th>model</th><th class=\"why\">file</th><th>format</th><th>" +
        std::string(noun_of_elements(comparison)) +
        "</th>"
        "<th>covered %</th><th>gap mm</th><th>excess</th><th>missing</th><th>out max mm</th>"
        "<th>out mean mm</th><th>certified</th></tr></thead><tbody>\n";
    for (const JudgedModel& judged : comparison.models) {
        const Measures& m = judged.evaluation.total.measures;
        html += fmt::format(
            "<tr><td>{}</td><td class=\"why\">{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>"
            "<td>{}</td><td>{}</td>{}</tr>\n",
            judged.label, markup_escaped(judged.model.file.file.string()), markup_escaped(judged.model.file.format),
            m.spheres, number(100 * m.covered, 2), number(1000 * m.gap, 2), number(m.excess, 3), number(m.missing, 3),
            number(1000 * m.protrusion_max, 1), number(1000 * m.protrusion_mean, 1),
            certified(proved_links(comparison.original, judged.model, judged.evaluation)));
    }
    return html + "</tbody></table></div>\n";
}

/// One scale for all models.
BarScale excess_scale(const Comparison& comparison) {
    std::vector<double> numbers;
    for (const JudgedModel& judged : comparison.models) {
        for (const Figures& link : judged.evaluation.links) {
            numbers.push_back(link.measures.excess);
        }
    }
    return BarScale(numbers, 5e-4);
}

std::string link_cells(const Measures& m, const BarScale& scale) {
    if (m.spheres == 0) {
        return "<td class=\"first\">–</td><td>–</td><td>–</td>";
    }
    return fmt::format("<td class=\"first\">{}</td><td>{}{}</td><td class=\"{}\">{}</td>", m.spheres,
                       number(m.excess, 3), scale.svg(m.excess), m.certified ? "yes" : "no", number(1000 * m.gap, 2));
}

std::string link_table(const Comparison& comparison) {
    std::string html = "<div class=\"wide\"><table><thead><tr><th></th>";
    for (const JudgedModel& judged : comparison.models) {
        html += fmt::format("<th class=\"first\" colspan=\"3\">{}</th>", judged.label);
    }
    html += "</tr><tr><th>link</th>";
    for (std::size_t i = 0; i < comparison.models.size(); ++i) {
        html += fmt::format("<th class=\"first\">{}</th><th>excess</th><th>gap mm</th>", noun_of_elements(comparison));
    }
    html += "</tr></thead><tbody>\n";
    const BarScale scale = excess_scale(comparison);
    for (std::size_t i = 0; i < comparison.original.links.size(); ++i) {
        html += fmt::format("<tr><td>{}</td>", markup_escaped(comparison.original.links[i].link));
        for (const JudgedModel& judged : comparison.models) {
            html += link_cells(judged.evaluation.links[i].measures, scale);
        }
        html += "</tr>\n";
    }
    html += "</tbody><tfoot><tr><td>total</td>";
    for (const JudgedModel& judged : comparison.models) {
        html += link_cells(judged.evaluation.total.measures, BarScale({}));
    }
    html += "</tr></tfoot></table></div>\n";
    return html + fmt::format("<p class=\"note\">Bars compare excess over links and models{}.</p>\n",
                              scale.logarithmic() ? fmt::format(", on a logarithmic scale from {:.3g} to {:.3g}",
                                                                scale.lowest(), scale.greatest())
                                                  : "");
}

std::string image(const std::string& png, const std::string& text) {
    return fmt::format("<figure><img alt=\"{}\" src=\"data:image/png;base64,{}\"></figure>\n", markup_escaped(text),
                       base64(png));
}

std::string link_pictures(const Comparison& comparison, const Pictures& pictures) {
    std::string html;
    for (std::size_t i = 0; i < pictures.links.size(); ++i) {
        const std::string& link = comparison.original.links[i].link;
        html += fmt::format("<h3>{}</h3>\n{}", markup_escaped(link),
                            image(pictures.links[i], link + " under the spheres of each model"));
    }
    return html.empty() ? "" : "<h2>Link by link</h2>\n" + html;
}

std::string notes(const Comparison& comparison) {
    std::string html;
    for (const JudgedModel& judged : comparison.models) {
        for (const std::string& note : judged.model.notes) {
            html += fmt::format("<li>{}: {}</li>\n", judged.label, markup_escaped(note));
        }
    }
    return html.empty() ? "" : "<h2>Notes</h2>\n<ul>\n" + html + "</ul>\n";
}

} // namespace

std::string html_of(const Comparison& comparison, const Pictures& pictures) {
    const std::string title = "Sphere models of " + comparison.original.file.filename().string();
    std::string html =
        "<header><h1>" + markup_escaped(title) + "</h1></header>\n<h2>The whole</h2>\n" + total_table(comparison);
    if (!pictures.whole.empty()) {
        html += image(pictures.whole, "The robot under the spheres of each model");
    }
    html += "<h2>Links</h2>\n" + link_table(comparison) + link_pictures(comparison, pictures) + notes(comparison);
    return html_page(
        title,
        html + fmt::format(
                   "<footer>covered: share of the surface inside the spheres. gap: how far the geometry extends beyond "
                   "the spheres. excess, missing: excess and missing volume / volume of the geometry. out: how far the "
                   "spheres extend beyond the geometry. certified: gap = 0 is proved. foam {}.</footer>\n",
                   version()));
}

} // namespace foam::cli
