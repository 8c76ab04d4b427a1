// UTF-16 and UTF-32, which lxml (yourdfpy, urdfpy) reads, as UTF-8.
#include "reader.hpp"

#include <fmt/format.h>

#include <cstdint>

namespace foam::urdf {
namespace {

struct Form {
    std::size_t width = 1; ///< bytes a unit; 1: no wide text
    bool big = false;      ///< the high byte is first
    std::size_t mark = 0;  ///< length of the byte order mark

    std::string name() const { return width == 2 ? "UTF-16" : "UTF-32"; }
};

/// Returns the form of a text by its mark, or by its first characters, "<?" or "<r": a text may begin with a NUL that
/// does not belong to it.
Form form_of(std::string_view text) {
    using namespace std::string_view_literals;
    const auto zero = [&](std::size_t at) { return at < text.size() && text[at] == '\0'; };
    if (text.starts_with("\xFF\xFE\0\0"sv)) {
        return {.width = 4, .big = false, .mark = 4};
    }
    if (text.starts_with("\0\0\xFE\xFF"sv)) {
        return {.width = 4, .big = true, .mark = 4};
    }
    if (text.starts_with("\xFF\xFE"sv) || text.starts_with("\xFE\xFF"sv)) {
        return {.width = 2, .big = text.front() == '\xFE', .mark = 2};
    }
    if (text.starts_with("<\0\0\0"sv) || text.starts_with("\0\0\0<"sv)) {
        return {.width = 4, .big = text.front() == '\0'};
    }
    if ((text.starts_with("<\0"sv) && zero(3)) || (text.starts_with("\0<"sv) && zero(2))) {
        return {.width = 2, .big = text.front() == '\0'};
    }
    return {};
}

std::uint32_t unit_at(std::string_view text, std::size_t at, const Form& form) {
    std::uint32_t unit = 0;
    for (std::size_t i = 0; i < form.width; ++i) {
        const std::size_t shift = 8 * (form.big ? form.width - 1 - i : i);
        unit |= static_cast<std::uint32_t>(static_cast<unsigned char>(text[at + i])) << shift;
    }
    return unit;
}

void append(std::string& text, std::uint32_t point) {
    if (point < 0x80) {
        text += static_cast<char>(point);
        return;
    }
    const int more = point < 0x800 ? 1 : point < 0x10000 ? 2 : 3;
    constexpr std::uint32_t first[] = {0, 0xC0, 0xE0, 0xF0};
    text += static_cast<char>(first[more] | point >> (6 * more));
    for (int i = more - 1; i >= 0; --i) {
        text += static_cast<char>(0x80U | (point >> (6 * i) & 0x3FU));
    }
}

/// Names UTF-8 as the encoding in the declaration, if that names one.
void correct_declaration(std::string& text) {
    const std::size_t end = text.starts_with("<?xml") ? text.find("?>") : 0;
    const std::size_t key = text.substr(0, end == text.npos ? 0 : end).find("encoding");
    const std::size_t quote = key == text.npos ? key : text.find_first_of("\"'", key);
    const std::size_t close = quote == text.npos ? quote : text.find(text[quote], quote + 1);
    if (close != text.npos && close < end) {
        text.replace(quote + 1, close - quote - 1, "UTF-8");
    }
}

} // namespace

std::string utf8_text(std::string_view text, const Reader& reader) {
    const Form form = form_of(text);
    if (form.width == 1) {
        return std::string(text);
    }
    std::string result;
    int line = 1;
    for (std::size_t at = form.mark; at + form.width <= text.size(); at += form.width) {
        std::uint32_t point = unit_at(text, at, form);
        if (form.width == 2 && point >= 0xD800 && point < 0xDC00 && at + 4 <= text.size()) {
            const std::uint32_t low = unit_at(text, at + 2, form);
            if (low >= 0xDC00 && low < 0xE000) {
                point = 0x10000 + ((point - 0xD800) << 10) + (low - 0xDC00);
                at += 2;
            }
        }
        if ((point >= 0xD800 && point < 0xE000) || point > 0x10FFFF) {
            reader.fail(line,
                        fmt::format("is no valid {}: half a character; remedy: get the file once more, not through "
                                    "a text conversion",
                                    form.name()));
        }
        line += point == '\n';
        append(result, point);
    }
    correct_declaration(result);
    reader.warn(1, fmt::format("the text is {0}, which ROS cannot read; what foam writes of it is UTF-8; remedy: iconv "
                               "-f {0}{1} -t UTF-8, and encoding=\"UTF-8\"",
                               form.name(),
                               form.mark > 0 ? ""
                               : form.big    ? "BE"
                                             : "LE"));
    return result;
}

std::string root_name_of(std::string_view text) {
    try {
        return std::string(form_of(text).width == 1 ? xml::root_name(text)
                                                    : xml::root_name(utf8_text(text, Reader(""))));
    } catch (const Error&) {
        return {};
    }
}

} // namespace foam::urdf
