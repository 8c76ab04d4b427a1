#include "page.hpp"

#include <foam/host/markup.hpp>

#include <fmt/format.h>

#include <charconv>
#include <cstdint>

namespace foam {
namespace report {
namespace {

/// Returns a source of Content Security Policy: only the text with this digest.
std::string source_of(const embedded::Text& text) {
    std::string bytes;
    for (std::size_t i = 0; i + 1 < text.sha256.size(); i += 2) {
        unsigned value = 0;
        std::from_chars(text.sha256.data() + i, text.sha256.data() + i + 2, value, 16);
        bytes += static_cast<char>(value);
    }
    return fmt::format("'sha256-{}'", base64(bytes));
}

} // namespace

std::string page(const std::string& title, const std::string& body, const std::vector<embedded::Text>& scripts) {
    std::string sources, elements;
    for (const embedded::Text& script : scripts) {
        sources += ' ';
        sources += source_of(script);
        elements += fmt::format("<script>{}</script>\n", script.text);
    }
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src {}; "
        "script-src{}; base-uri 'none'; form-action 'none'\">\n"
        "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<title>{}</title>\n"
        "<style>{}</style>\n</head>\n<body>\n{}{}</body>\n</html>\n",
        source_of(embedded::page_css), sources, markup_escaped(title), embedded::page_css.text, body, elements);
}

} // namespace report

std::string base64(std::string_view bytes) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string result;
    result.reserve((bytes.size() + 2) / 3 * 4);
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

std::string html_page(const std::string& title, const std::string& body) {
    return report::page(title, body, {embedded::page_js});
}

} // namespace foam
