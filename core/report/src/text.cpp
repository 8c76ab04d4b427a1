#include "text.hpp"

#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace foam::inline report {

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

} // namespace foam::report
