#include "readers.hpp"

#include <fmt/format.h>

namespace foam::load_assimp {

namespace {

constexpr std::size_t deepest = 500; ///< nesting of elements: assimp recurses

/// The tag that starts at text[at], without its brackets; comments, CDATA and instructions count as tags of no depth.
std::string_view tag_at(std::string_view text, std::size_t at) {
    for (const auto& [begin, end] :
         {std::pair<std::string_view, std::string_view>{"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}}) {
        if (text.substr(at).starts_with(begin)) {
            const std::size_t stop = text.find(end, at);
            return text.substr(at, stop == text.npos ? text.npos : stop + end.size() - at);
        }
    }
    const std::size_t stop = text.find('>', at);
    return text.substr(at, stop == text.npos ? text.npos : stop + 1 - at);
}

/// assimp reserves memory for what count="…" and stride="…" promise; each value takes at least one byte of text.
void check_counts(const Source& source, std::string_view tag, std::size_t line) {
    for (const std::string_view name : {" count=", " stride=", " offset=", " set="}) {
        const std::size_t at = tag.find(name);
        if (at == tag.npos || at + name.size() + 1 >= tag.size()) {
            continue;
        }
        std::string_view value = tag.substr(at + name.size() + 1);
        value = value.substr(0, value.find_first_of("\"'"));
        const auto number = to_integer(value);
        if (!number || *number < 0 || static_cast<std::uint64_t>(*number) > source.bytes.size()) {
            throw source.error_at(line,
                                  fmt::format("{}{} cannot be true of a file of {} bytes; remedy: export it again",
                                              name.substr(1), printable(value), source.bytes.size()));
        }
    }
}

} // namespace

void check_collada(const Source& source) {
    const std::string_view text = source.bytes;
    if (text.find("<COLLADA") == text.npos) {
        throw source.error("it holds no COLLADA: there is no element <COLLADA>");
    }
    std::size_t depth = 0, line = 1, counted = 0;
    for (std::size_t at = text.find('<'); at < text.size(); at = text.find('<', at)) {
        line += static_cast<std::size_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(counted),
                                                    text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
        counted = at;
        const std::string_view tag = tag_at(text, at);
        at += tag.size();
        if (tag.starts_with("<!") || tag.starts_with("<?")) {
            continue;
        }
        if (tag.starts_with("</")) {
            depth -= depth > 0 ? 1 : 0;
            continue;
        }
        check_counts(source, tag, line);
        if (!tag.ends_with("/>") && ++depth > deepest) {
            throw source.error_at(line, fmt::format("its elements are nested more than {} deep", deepest));
        }
    }
}

} // namespace foam::load_assimp
