#include "page.hpp"
#include "embedded_resources.hpp"
#include "text.hpp"

#include <foam/base/text.hpp>
#include <foam/report/html_page.hpp>
#include <foam/report/internal/policy.hpp>

#include <fmt/format.h>

#include <charconv>
#include <cstdint>

namespace foam::inline report {

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

} // namespace foam::report
