#include <foam/base/text.hpp>

#include <algorithm>
#include <charconv>
#include <cstdint>

namespace foam::inline base {
namespace {

struct Character {
    std::size_t bytes = 0; ///< 0: the text does not begin with UTF-8
    char32_t code = 0;
};

/// Returns the first character of a nonempty text: the shortest form only, no surrogate.
Character first_character(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char lead = byte(0);
    const std::size_t bytes = lead < 0x80                   ? 1
                              : lead >= 0xF0 && lead < 0xF8 ? 4
                              : lead >= 0xE0                ? 3
                              : lead >= 0xC0                ? 2
                                                            : 0;
    if (bytes == 0 || lead >= 0xF8 || bytes > text.size()) {
        return {};
    }
    char32_t code = bytes == 1 ? lead : lead & (0x7FU >> bytes);
    for (std::size_t i = 1; i < bytes; ++i) {
        if ((byte(i) & 0xC0U) != 0x80U) {
            return {};
        }
        code = (code << 6U) | (byte(i) & 0x3FU);
    }
    constexpr char32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    const bool valid = code >= least[bytes] && code <= 0x10FFFF && !(code >= 0xD800 && code <= 0xDFFF);
    return valid ? Character{bytes, code} : Character{};
}

bool is_steering(char32_t code) {
    return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x61C || code == 0x200E || code == 0x200F ||
           (code >= 0x2028 && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069) || code == 0xFEFF;
}

std::string hexadecimal(char32_t number, std::size_t least_digits) {
    char buffer[8];
    const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, static_cast<std::uint32_t>(number), 16);
    const std::string digits(buffer, end);
    return std::string(least_digits - std::min(least_digits, digits.size()), '0') + digits;
}

std::string shown_but(std::string_view text, std::string_view kept) {
    std::string result;
    while (!text.empty()) {
        const auto [bytes, code] = first_character(text);
        const auto lead = static_cast<unsigned char>(text.front());
        if (bytes == 0 || (code < 0x80 && is_steering(code) && kept.find(text.front()) == std::string_view::npos)) {
            result += "\\x" + hexadecimal(lead, 2);
        } else if (code >= 0x80 && is_steering(code)) {
            result += "\\u{" + hexadecimal(code, 4) + "}";
        } else {
            result += text.substr(0, bytes);
        }
        text.remove_prefix(std::max<std::size_t>(bytes, 1));
    }
    return result;
}

/// Returns whether the character combines with the one before it.
bool is_combining(char32_t code) {
    return (code >= 0x300 && code <= 0x36F) || (code >= 0x1AB0 && code <= 0x1AFF) ||
           (code >= 0x1DC0 && code <= 0x1DFF) || (code >= 0x20D0 && code <= 0x20FF) ||
           (code >= 0xFE00 && code <= 0xFE0F) || code == 0x200B || code == 0x200C || code == 0x200D;
}

/// Returns whether the character takes two columns: East Asian characters and pictures.
bool is_wide(char32_t code) {
    return (code >= 0x1100 && code <= 0x115F) || (code >= 0x2E80 && code <= 0xA4CF && code != 0x303F) ||
           (code >= 0xAC00 && code <= 0xD7A3) || (code >= 0xF900 && code <= 0xFAFF) ||
           (code >= 0xFE30 && code <= 0xFE6F) || (code >= 0xFF00 && code <= 0xFF60) ||
           (code >= 0xFFE0 && code <= 0xFFE6) || (code >= 0x1F300 && code <= 0x1F64F) ||
           (code >= 0x1F900 && code <= 0x1F9FF) || (code >= 0x20000 && code <= 0x3FFFD);
}

int hex_digit(char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

} // namespace

std::string counted(std::size_t count, std::string_view noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : noun.ends_with("sh") ? "es" : "s");
}

std::string first_names(const std::vector<std::string>& names) {
    constexpr std::size_t most = 3;
    std::string text;
    for (std::size_t i = 0; i < std::min(names.size(), most); ++i) {
        text += (i > 0 ? ", " : "") + names[i];
    }
    return names.size() > most ? fmt::format("{} and {} more", text, names.size() - most) : text;
}

std::string with_article(std::string_view noun) {
    constexpr std::string_view vowels = "aeiou";
    const bool vowel = !noun.empty() && vowels.find(noun.front()) != vowels.npos;
    return fmt::format("{} {}", vowel ? "an" : "a", noun);
}

std::string shown(std::string_view text) {
    return shown_but(text, "");
}

std::string shown_lines(std::string_view text) {
    return shown_but(text, "\n");
}

std::size_t shown_width(std::string_view text) {
    std::size_t width = 0;
    while (!text.empty()) {
        const auto [bytes, code] = first_character(text);
        width += is_combining(code) ? 0 : is_wide(code) ? 2 : 1;
        text.remove_prefix(std::max<std::size_t>(bytes, 1));
    }
    return width;
}

std::string lower_case(std::string_view text) {
    std::string result(text);
    for (char& c : result) {
        c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
    return result;
}

std::string percent_decoded(std::string_view text) {
    std::string decoded;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const int high = text[i] == '%' && i + 2 < text.size() ? hex_digit(text[i + 1]) : -1;
        const int low = high >= 0 ? hex_digit(text[i + 2]) : -1;
        if (low >= 0 && high + low > 0) {
            decoded.push_back(static_cast<char>(high * 16 + low));
            i += 2;
        } else {
            decoded.push_back(text[i]);
        }
    }
    return decoded;
}

std::vector<std::string_view> words(std::string_view text) {
    constexpr std::string_view blank = " \t\r\n";
    std::vector<std::string_view> result;
    for (std::size_t begin = 0; (begin = text.find_first_not_of(blank, begin)) != std::string_view::npos;) {
        const std::size_t end = std::min(text.find_first_of(blank, begin), text.size());
        result.push_back(text.substr(begin, end - begin));
        begin = end;
    }
    return result;
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
    // Optimal string alignment (Damerau 1964): three rows of the table are enough.
    std::vector<std::size_t> before(b.size() + 1), previous(b.size() + 1), current(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) {
        previous[j] = j;
    }
    for (std::size_t i = 1; i <= a.size(); ++i) {
        current[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
            current[j] = std::min({previous[j] + 1, current[j - 1] + 1, previous[j - 1] + change});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                current[j] = std::min(current[j], before[j - 2] + 1);
            }
        }
        std::swap(before, previous);
        std::swap(previous, current);
    }
    return previous[b.size()];
}

std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates) {
    std::string best;
    std::size_t best_distance = std::clamp<std::size_t>(word.size() / 3, 1, 3) + 1;
    for (const std::string& candidate : candidates) {
        const std::size_t distance = edit_distance(word, candidate);
        if (distance < best_distance) {
            best_distance = distance;
            best = candidate;
        }
    }
    return best;
}

std::string markup_escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        case '"':
            result += "&quot;";
            break;
        default:
            result += c;
        }
    }
    return result;
}

std::string attribute_escaped(std::string_view text) {
    std::string result;
    for (const char c : markup_escaped(text)) {
        result += c == '\n' ? "&#10;" : c == '\r' ? "&#13;" : c == '\t' ? "&#9;" : std::string(1, c);
    }
    return result;
}

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

} // namespace foam::inline base
