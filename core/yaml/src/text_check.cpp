#include <foam/yaml/value.hpp>

#include <fmt/format.h>

namespace foam::yaml {
namespace {

/// Returns the length of the UTF-8 character at `at` (RFC 3629: no overlong forms, no surrogates, at most U+10FFFF); 0:
/// not a character.
std::size_t character_length(std::string_view text, std::size_t at) {
    const auto byte = [&](std::size_t i) -> unsigned {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
    };
    const unsigned first = byte(at);
    if (first < 0x80) {
        return 1;
    }
    const std::size_t length = first >= 0xC2 && first <= 0xDF   ? 2
                               : first >= 0xE0 && first <= 0xEF ? 3
                               : first >= 0xF0 && first <= 0xF4 ? 4
                                                                : 0;
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(at + i) & 0xC0U) != 0x80U) {
            return 0;
        }
    }
    const unsigned second = byte(at + 1);
    const bool outside = (first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
                         (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F);
    return outside ? 0 : length;
}

} // namespace

bool check_text(const std::string& text, int source, Findings& findings, const TextKind& kind) {
    if (text.size() > kind.most_bytes) {
        findings.error({source, 0, 0}, "too-large",
                       fmt::format("the text has more than {} bytes; is this file a {}?", kind.most_bytes, kind.name));
        return false;
    }
    int line = 1, column = 1;
    for (std::size_t at = 0; at < text.size(); ++column) {
        const auto byte = static_cast<unsigned char>(text[at]);
        const std::size_t length = character_length(text, at);
        if (length == 0) {
            findings.error({source, line, column}, "encoding",
                           fmt::format("byte 0x{:02x} is not UTF-8; remedy: save the {} as UTF-8", byte, kind.name));
            return false;
        }
        if ((byte < 0x20 && byte != '\t' && byte != '\n' && byte != '\r') || byte == 0x7F) {
            findings.error({source, line, column}, "encoding",
                           fmt::format("control character 0x{:02x} in the text; remedy: delete it (UTF-16 files: save "
                                       "the {} as UTF-8)",
                                       byte, kind.name));
            return false;
        }
        if (byte == '\n') {
            ++line;
            column = 0;
        }
        at += length;
    }
    return true;
}

} // namespace foam::yaml
