// A comparison as one HTML file: no other file, no network, no script.
#include "comparison.hpp"

#include <foam/host/markup.hpp>
#include <foam/host/version.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace foam::cli {
namespace {

constexpr std::string_view style =
    R"(:root{color-scheme:light dark;--line:#c8ccd0;--bar:#8ab4e8;--bad:#c0392b;--good:#1e8449}
@media(prefers-color-scheme:dark){:root{--line:#454b52;--bar:#3b5f8a;--bad:#ff8a75;--good:#7bd88f}}
body{font:15px/1.5 system-ui,sans-serif;margin:2rem auto;max-width:75rem;padding:0 1rem}
h1{font-size:1.5rem}h2{font-size:1.15rem;margin-top:2rem}
.wide{overflow-x:auto}table{border-collapse:collapse;font-variant-numeric:tabular-nums}
th,td{padding:.25rem .7rem;text-align:right;border-bottom:1px solid var(--line);white-space:nowrap}
th:first-child,td:first-child{text-align:left}th.first,td.first{border-left:2px solid var(--line)}
.bar{display:block;height:.35rem;background:var(--bar)}.yes{color:var(--good)}.no{color:var(--bad)}
img{max-width:100%;height:auto;background:#fff;border:1px solid var(--line)}footer{margin-top:2rem;opacity:.7})";

std::string base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string result;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            result += i + k > bytes.size() ? '=' : digits[group >> (18 - 6 * k) & 63U];
        }
    }
    return result;
}

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
    return fmt::format("<td class=\"first\">{}</td><td>{}<span class=\"bar\" style=\"width:{:.1f}%\"></span></td>"
                       "<td class=\"{}\">{}</td>",
                       m.spheres, number(m.excess, 3), 100 * share, m.certified ? "yes" : "no",
                       number(1000 * m.gap, 2));
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
    const std::string title = "Sphere models of " + markup_escaped(comparison.original.file.filename().string());
    std::string html =
        fmt::format("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}</title>\n"
                    "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n"
                    "<style>{1}</style></head><body>\n<h1>{0}</h1>\n",
                    title, style);
    html += total_table(comparison);
    if (!png.empty()) {
        html += fmt::format(
            "<p><img alt=\"The robot under the spheres of each model\" src=\"data:image/png;base64,{}\"></p>\n",
            base64(png));
    }
    html += "<h2>Links</h2>\n" + link_table(comparison) + notes(comparison);
    return html +
           fmt::format("<footer>covered: share of the surface that lies in the spheres. gap: how far the geometry "
                       "sticks out. excess, missing: volume wrongly claimed and left out, over the volume of the "
                       "geometry. out: how far the spheres stick out. certified: gap 0 is proved. foam {}.</footer>\n"
                       "</body></html>\n",
                       version());
}

} // namespace foam::cli
