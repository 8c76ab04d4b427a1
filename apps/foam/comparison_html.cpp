// A comparison as one HTML file: no other file, no network.
#include "comparison.hpp"

#include <foam/host/markup.hpp>
#include <foam/host/version.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace foam::cli {
namespace {

std::string number(double value, int digits) {
    return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "∞";
}

std::string certified(bool yes) {
    return yes ? "<td class=\"yes\">yes</td>" : "<td class=\"no\">no</td>";
}

std::string total_table(const Comparison& comparison) {
    std::string html =
        "<div class=\"wide\"><table><thead><tr><th>model</th><th>file</th><th>format</th><th>spheres</th>"
        "<th>covered %</th><th>gap mm</th><th>excess</th><th>missing</th><th>out max mm</th>"
        "<th>out mean mm</th><th>certified</th></tr></thead><tbody>\n";
    for (const JudgedModel& judged : comparison.models) {
        const Measures& m = judged.evaluation.total.measures;
        html += fmt::format(
            "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>"
            "<td>{}</td><td>{}</td>{}</tr>\n",
            judged.label, markup_escaped(judged.model.file.file.string()), markup_escaped(judged.model.file.format),
            m.spheres, number(100 * m.covered, 2), number(1000 * m.gap, 2), number(m.excess, 3), number(m.missing, 3),
            number(1000 * m.protrusion_max, 1), number(1000 * m.protrusion_mean, 1), certified(m.certified));
    }
    return html + "</tbody></table></div>\n";
}

/// The largest finite excess of a link: the length of a full bar.
double longest_bar(const Comparison& comparison) {
    double longest = 0;
    for (const JudgedModel& judged : comparison.models) {
        for (const Figures& link : judged.evaluation.links) {
            longest = std::isfinite(link.measures.excess) ? std::max(longest, link.measures.excess) : longest;
        }
    }
    return longest;
}

std::string link_cells(const Measures& m, double longest) {
    if (m.spheres == 0) {
        return "<td class=\"first\">–</td><td>–</td><td>–</td>";
    }
    const double share = longest > 0 && std::isfinite(m.excess) ? m.excess / longest : 0;
    return fmt::format(
        "<td class=\"first\">{}</td><td>{}<svg class=\"bar\" viewBox=\"0 0 100 4\" "
        "preserveAspectRatio=\"none\" aria-hidden=\"true\"><rect width=\"{:.1f}\" height=\"4\"/></svg></td>"
        "<td class=\"{}\">{}</td>",
        m.spheres, number(m.excess, 3), 100 * share, m.certified ? "yes" : "no", number(1000 * m.gap, 2));
}

std::string link_table(const Comparison& comparison) {
    std::string html = "<div class=\"wide\"><table><thead><tr><th></th>";
    for (const JudgedModel& judged : comparison.models) {
        html += fmt::format("<th class=\"first\" colspan=\"3\">{}</th>", judged.label);
    }
    html += "</tr><tr><th>link</th>";
    for (std::size_t i = 0; i < comparison.models.size(); ++i) {
        html += "<th class=\"first\">spheres</th><th>excess</th><th>gap mm</th>";
    }
    html += "</tr></thead><tbody>\n";
    const double longest = longest_bar(comparison);
    for (std::size_t i = 0; i < comparison.original.links.size(); ++i) {
        html += fmt::format("<tr><td>{}</td>", markup_escaped(comparison.original.links[i].link));
        for (const JudgedModel& judged : comparison.models) {
            html += link_cells(judged.evaluation.links[i].measures, longest);
        }
        html += "</tr>\n";
    }
    return html + "</tbody></table></div>\n";
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

std::string html_of(const Comparison& comparison, const std::string& png) {
    const std::string title = "Sphere models of " + comparison.original.file.filename().string();
    std::string html = "<header><h1>" + markup_escaped(title) + "</h1></header>\n" + total_table(comparison);
    if (!png.empty()) {
        html += fmt::format(
            "<p><img alt=\"The robot under the spheres of each model\" src=\"data:image/png;base64,{}\"></p>\n",
            base64(png));
    }
    html += "<h2>Links</h2>\n" + link_table(comparison) + notes(comparison);
    return html_page(title,
                     html + fmt::format("<footer>covered: share of the surface that lies in the spheres. gap: how far "
                                        "the geometry sticks out. excess, missing: volume wrongly claimed and left "
                                        "out, over the volume of the geometry. out: how far the spheres stick out. "
                                        "certified: gap 0 is proved. foam {}.</footer>\n",
                                        version()));
}

} // namespace foam::cli
