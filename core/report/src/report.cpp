// The page of the report, and the text and bars of its sections.
#include <foam/report/internal/report.hpp>

#include "embedded_resources.hpp"
#include "sections.hpp"

#include <foam/base/text.hpp>
#include <foam/report/html_page.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>

namespace foam::inline report {

std::string to_html(const Report& report) {
    std::string body = header_section(report) + "<main>\n";
    for (const auto section :
         {summary_section, viewer_section, links_section, radii_section, stages_section, proof_section,
          findings_section, recipe_section, files_section, reproduce_section, execution_section}) {
        body += section(report);
    }
    const auto name = report.manifest["settings"]["name"].get<std::string>();
    return page(name + " as spheres", body + "</main>\n",
                {resources::page_js, resources::renderer_js, resources::palette_js, resources::camera_js,
                 resources::viewer_js});
}

std::string policy_source(const EmbeddedText& text) {
    std::string bytes;
    for (std::size_t i = 0; i + 1 < text.sha256.size(); i += 2) {
        unsigned value = 0;
        std::from_chars(text.sha256.data() + i, text.sha256.data() + i + 2, value, 16);
        bytes += static_cast<char>(value);
    }
    return fmt::format("'sha256-{}'", base64(bytes));
}

std::string page(const std::string& title, const std::string& body, const std::vector<EmbeddedText>& scripts) {
    std::string sources, elements;
    for (const EmbeddedText& script : scripts) {
        sources += ' ';
        sources += policy_source(script);
        elements += fmt::format("<script>{}</script>\n", script.text);
    }
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src {}; "
        "script-src{}; base-uri 'none'; form-action 'none'\">\n"
        "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<title>{}</title>\n"
        "<style>{}</style>\n</head>\n<body>\n{}{}</body>\n</html>\n",
        policy_source(resources::page_css), sources, as_text(title), resources::page_css.text, body, elements);
}

std::string html_page(const std::string& title, const std::string& body) {
    return page(title, body, {resources::page_js});
}

double value_of(const Json& number) {
    return number.is_null() ? std::numeric_limits<double>::infinity() : number.get<double>();
}

std::string number(double value, int digits) {
    return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "∞";
}

std::string as_text(std::string_view text) {
    return markup_escaped(shown(text));
}

std::string as_lines(std::string_view text) {
    return markup_escaped(shown_lines(text));
}

std::string escaped(const Json& text) {
    return as_text(text.get<std::string>());
}

std::string cell(double value, const std::string& html) {
    return fmt::format("<td data-value=\"{}\">{}</td>", std::isfinite(value) ? fmt::format("{}", value) : "Infinity",
                       html);
}

std::string yes_no_cell(bool yes) {
    return fmt::format("<td data-value=\"{}\" class=\"{}\">{}</td>", yes ? 1 : 0, yes ? "yes" : "no",
                       yes ? "✓ yes" : "✗ no");
}

std::string execution_only(const std::string& html) {
    return "<!--execution-->" + html + "<!--/execution-->";
}

std::string section(const std::string& id, const std::string& title, const std::string& html) {
    return fmt::format("<section id=\"{0}\" aria-labelledby=\"{0}-title\">\n<h2 id=\"{0}-title\">{1}</h2>\n"
                       "{2}</section>\n",
                       id, title, html);
}

namespace {

constexpr double linear_span = 30; ///< shorter bars cannot be told apart

} // namespace

BarScale::BarScale(const std::vector<double>& numbers, double least_shown, bool always_linear)
    : least_shown_(least_shown) {
    double least = std::numeric_limits<double>::infinity();
    for (const double number : numbers) {
        if (std::isfinite(number) && number > 0 && number >= least_shown) {
            least = std::min(least, number);
            greatest_ = std::max(greatest_, number);
        }
    }
    if (!always_linear && greatest_ > linear_span * least) {
        lowest_ = std::pow(10, std::ceil(std::log10(least)) - 1);
    }
}

double BarScale::share(double number) const {
    if (empty() || !(number > 0) || number < least_shown_) {
        return 0;
    }
    const double share =
        logarithmic() ? std::log(number / lowest_) / std::log(greatest_ / lowest_) : number / greatest_;
    return std::clamp(share, 0.0, 1.0);
}

std::string BarScale::svg(double number) const {
    const double length = share(number);
    return length > 0 ? fmt::format("<svg class=\"bar\" viewBox=\"0 0 100 4\" preserveAspectRatio=\"none\" "
                                    "aria-hidden=\"true\"><rect width=\"{:.1f}\" height=\"4\"/></svg>",
                                    100 * length)
                      : "";
}

} // namespace foam::inline report
