#include "mend.hpp"

#include <foam/base/text.hpp>

#include <algorithm>
#include <array>
#include <cstdint>

namespace foam::xml {
namespace {

constexpr std::string_view mark = "\xEF\xBB\xBF"; ///< the byte order mark of UTF-8

int line_at(std::string_view text, std::size_t at) {
    return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

/// Returns the length of the blanks, NULs, byte order marks and comments that the text begins with.
std::size_t prelude(std::string_view text) {
    std::size_t at = 0;
    while (at < text.size()) {
        const std::string_view rest = text.substr(at);
        if (std::string_view(" \t\r\n\0", 5).find(rest.front()) != rest.npos) {
            ++at;
        } else if (rest.starts_with(mark)) {
            at += mark.size();
        } else if (rest.starts_with("<!--") && rest.find("-->") != rest.npos) {
            at += rest.find("-->") + 3;
        } else {
            break;
        }
    }
    return at;
}

/// Puts the declaration first, where expat wants it, and blanks in place of NULs and byte order marks.
void mend_start(Mended& result) {
    std::string& text = result.text;
    const std::size_t from = text.starts_with(mark) ? mark.size() : 0, length = prelude(text);
    const bool declared = std::string_view(text).substr(length).starts_with("<?xml ");
    const auto begin = text.begin() + static_cast<std::ptrdiff_t>(from);
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(length);
    const bool stray = std::find(begin, end, '\0') != end ||
                       std::string_view(text).substr(from, length - from).find(mark) != std::string_view::npos;
    if (length == from || !(declared || stray)) {
        return;
    }
    for (std::size_t at = from; at < length; ++at) {
        const std::size_t odd = text[at] == '\0' ? 1 : text.compare(at, mark.size(), mark) == 0 ? mark.size() : 0;
        std::fill_n(text.begin() + static_cast<std::ptrdiff_t>(at), odd, ' ');
    }
    if (declared) {
        const std::size_t close = std::min(text.find("?>", length), text.size() - 2) + 2;
        std::rotate(begin, end, text.begin() + static_cast<std::ptrdiff_t>(close));
    }
    result.faults.push_back({1, declared ? "something stands before the XML declaration; remedy: let the file begin "
                                           "with <?xml"
                                         : "a NUL or a byte order mark stands before the document; remedy: let the "
                                           "file begin with <"});
}

void mend_comments(Mended& result) {
    std::string& text = result.text;
    bool told = false;
    for (std::size_t at = text.find("<!--"); at != text.npos; at = text.find("<!--", at)) {
        const std::size_t begin = at + 4, end = text.find("-->", begin);
        if (end == text.npos) {
            return;
        }
        for (std::size_t i = begin; i < end; ++i) {
            const bool last = i + 1 == end;
            if (text[i] == '-' && (last || text[i + 1] == '-')) {
                if (!told) {
                    result.faults.push_back({line_at(text, i), "a comment has '--' in it; remedy: write one '-'"});
                    told = true;
                }
                text[i] = ' ';
            }
        }
        at = end + 3;
    }
}

bool begins_entity(std::string_view text) {
    const std::size_t end = text.find_first_of("; \t\r\n<&\"'", 1);
    return end != text.npos && end > 1 && text[end] == ';';
}

/// Replaces each '&' that begins no entity, unless a character or a number could be taken for what replaces it.
void mend_ampersands(Mended& result) {
    std::string& text = result.text;
    if (text.find(bare_ampersand) != text.npos || text.find("&#") != text.npos) {
        return;
    }
    for (std::size_t at = text.find_first_of("&<"); at != text.npos; at = text.find_first_of("&<", at + 1)) {
        if (const char* close = text.compare(at, 4, "<!--") == 0        ? "-->"
                                : text.compare(at, 9, "<![CDATA[") == 0 ? "]]>"
                                                                        : nullptr) {
            at = std::min(text.find(close, at), text.size() - 1);
        } else if (text[at] == '&' && !begins_entity(std::string_view(text).substr(at))) {
            if (!result.has_bare_ampersands) {
                result.faults.push_back({line_at(text, at), "a '&' begins no entity; remedy: write &amp;"});
            }
            result.has_bare_ampersands = true;
            text[at] = bare_ampersand;
        }
    }
}

bool is_valid_utf8(std::string_view text) {
    for (std::size_t at = 0; at < text.size();) {
        const auto byte = static_cast<unsigned char>(text[at++]);
        const int more = byte < 0x80                   ? 0
                         : byte >= 0xC2 && byte < 0xE0 ? 1
                         : byte >= 0xE0 && byte < 0xF0 ? 2
                         : byte >= 0xF0 && byte < 0xF5 ? 3
                                                       : -1;
        for (int i = 0; i < more; ++i, ++at) {
            if (at >= text.size() || (static_cast<unsigned char>(text[at]) & 0xC0U) != 0x80) {
                return false;
            }
        }
        if (more < 0) {
            return false;
        }
    }
    return true;
}

/// Returns the encoding that the declaration names, in lower case; empty if it names none.
std::string declared_encoding(std::string_view text) {
    text.remove_prefix(text.starts_with(mark) ? mark.size() : 0);
    const std::string_view declaration =
        text.starts_with("<?xml") ? text.substr(0, std::min(text.find("?>"), text.size())) : std::string_view();
    const std::size_t key = declaration.find("encoding");
    const std::size_t quote = key == declaration.npos ? key : declaration.find_first_of("\"'", key);
    if (quote == declaration.npos) {
        return {};
    }
    return lower_case(declaration.substr(quote + 1, declaration.find(declaration[quote], quote + 1) - quote - 1));
}

/// Chooses an encoding where expat would refuse the text for it: names then have one letter a byte, as other readers
/// keep them.
void mend_encoding(Mended& result) {
    const std::string declared = declared_encoding(result.text);
    const bool utf8 = declared.empty() || declared == "utf-8" || declared == "us-ascii";
    if ((utf8 && is_valid_utf8(result.text)) || declared == "iso-8859-1") {
        return;
    }
    const bool is_utf8 = is_valid_utf8(result.text);
    result.encoding = is_utf8 ? "UTF-8" : "ISO-8859-1";
    result.faults.push_back(
        {1, utf8      ? std::string("the text is not UTF-8; remedy: iconv -f ENCODING -t UTF-8")
            : is_utf8 ? "the text is UTF-8, and not '" + declared + "' as it says; remedy: encoding=\"UTF-8\""
                      : "the encoding '" + declared + "' is read as ISO-8859-1; remedy: iconv -f " + declared +
                            " -t UTF-8, and encoding=\"UTF-8\""});
}

} // namespace

Mended mended(std::string_view text) {
    Mended result{.text = std::string(text), .faults = {}};
    mend_start(result);
    mend_comments(result);
    mend_ampersands(result);
    mend_encoding(result);
    return result;
}

} // namespace foam::xml
