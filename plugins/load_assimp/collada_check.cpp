// What assimp takes on trust in a COLLADA file: counts, the ranges of accessors, the depth of nesting.
#include "readers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace foam::load_assimp {
namespace {

constexpr std::size_t deepest = 500; ///< nesting of elements: assimp recurses

/// The tag that starts at text[at], with its brackets; comments, CDATA and instructions as a whole.
std::string_view tag_at(std::string_view text, std::size_t at) {
    using Pair = std::pair<std::string_view, std::string_view>;
    for (const auto& [begin, end] : {Pair{"<!--", "-->"}, Pair{"<![CDATA[", "]]>"}, Pair{"<?", "?>"}, Pair{"<", ">"}}) {
        if (text.substr(at).starts_with(begin)) {
            const std::size_t stop = text.find(end, at);
            return text.substr(at, stop == text.npos ? text.npos : stop + end.size() - at);
        }
    }
    return {};
}

std::string_view name_of(std::string_view tag) {
    return tag.substr(1, std::min(tag.find_first_of(" \t\r\n/>", 1), tag.size()) - 1);
}

std::optional<std::string_view> attribute(std::string_view tag, std::string_view name) {
    for (std::size_t at = tag.find(name); at != tag.npos; at = tag.find(name, at + 1)) {
        const std::size_t equals = tag.find_first_not_of(" \t\r\n", at + name.size());
        const bool begins = std::string_view(" \t\r\n").find(tag[at - 1]) != tag.npos;
        if (!begins || equals == tag.npos || tag[equals] != '=') {
            continue;
        }
        const std::size_t quote = tag.find_first_not_of(" \t\r\n", equals + 1);
        if (quote != tag.npos && (tag[quote] == '"' || tag[quote] == '\'')) {
            const std::size_t end = tag.find(tag[quote], quote + 1);
            return tag.substr(quote + 1, end == tag.npos ? tag.npos : end - quote - 1);
        }
    }
    return std::nullopt;
}

class ColladaCheck {
public:
    explicit ColladaCheck(const Source& source) : source_(source) {}

    void run() {
        const std::string_view text = source_.bytes;
        std::size_t depth = 0;
        for (std::size_t at = text.find('<'); at < text.size(); at = text.find('<', at)) {
            move_to(at);
            const std::string_view tag = tag_at(text, at);
            at += tag.size();
            if (tag.starts_with("<!") || tag.starts_with("<?")) {
                continue;
            }
            if (tag.starts_with("</")) {
                depth -= depth > 0 ? 1 : 0;
                continue;
            }
            element(tag);
            if (!tag.ends_with("/>")) {
                const std::string_view rest = text.substr(at);
                content(name_of(tag), rest.substr(0, rest.find('<')), attribute(tag, "count"));
            }
            if (!tag.ends_with("/>") && ++depth > deepest) {
                throw source_.error_at(line_, fmt::format("its elements are nested more than {} deep", deepest));
            }
        }
        for (const Accessor& accessor : accessors_) {
            check(accessor);
        }
    }

private:
    struct Accessor {
        std::size_t line;
        std::string_view array;
        std::uint64_t end; ///< one past its last value
    };

    void move_to(std::size_t at) {
        const auto begin = source_.bytes.begin();
        line_ += static_cast<std::size_t>(
            std::count(begin + static_cast<std::ptrdiff_t>(at_), begin + static_cast<std::ptrdiff_t>(at), '\n'));
        at_ = at;
    }

    void element(std::string_view tag) {
        const std::string_view name = name_of(tag);
        // assimp reserves memory for what a count promises; each value takes at least one byte of text.
        const auto count = natural(tag, "count");
        if (name == "float_array") {
            if (!count) {
                throw source_.error_at(line_, "the float_array has no count; remedy: export the mesh again");
            }
            arrays_[attribute(tag, "id").value_or("")] = *count;
        } else if (name == "accessor") {
            const std::uint64_t stride = natural(tag, "stride").value_or(1),
                                offset = natural(tag, "offset").value_or(0);
            const std::string_view array = attribute(tag, "source").value_or("#");
            accessors_.push_back({line_, array.substr(array.empty() ? 0 : 1), offset + count.value_or(0) * stride});
        } else if (name == "input") {
            natural(tag, "offset");
        }
    }

    /// assimp does not get past a word that is no number, or reads on behind the end where there are too few.
    void content(std::string_view name, std::string_view text, std::optional<std::string_view> count) {
        static const std::map<std::string_view, std::size_t> transforms{{"matrix", 16}, {"translate", 3}, {"scale", 3},
                                                                        {"rotate", 4},  {"lookat", 9},    {"skew", 7}};
        static const std::set<std::string_view> index_lists{"p", "h", "vcount", "v"};
        const auto transform = transforms.find(name);
        const bool indices = index_lists.contains(name);
        if (name != "float_array" && transform == transforms.end() && !indices) {
            return;
        }
        std::size_t words = 0;
        for (std::size_t at = 0; (at = text.find_first_not_of(" \t\r\n", at)) != text.npos; ++words) {
            const std::size_t end = std::min(text.find_first_of(" \t\r\n", at), text.size());
            const std::string_view word = text.substr(at, end - at);
            const bool good =
                indices ? to_integer(word).value_or(-1) >= (name == "v" ? -1 : 0) : to_number(word).has_value();
            if (!good) {
                move_to(static_cast<std::size_t>(word.data() - source_.bytes.data()));
                throw source_.error_at(line_,
                                       fmt::format("<{}> holds {}, which is no {}; remedy: export the mesh again", name,
                                                   printable(word), indices ? "index" : "number"));
            }
            at = end;
        }
        const std::size_t needed = transform != transforms.end() ? transform->second
                                   : name == "float_array" ? static_cast<std::size_t>(to_integer(*count).value_or(0))
                                                           : 0;
        if (words < needed) {
            throw source_.error_at(line_,
                                   fmt::format("<{}> holds {} numbers, {} are needed; remedy: export the mesh again",
                                               name, words, needed));
        }
    }

    std::optional<std::uint64_t> natural(std::string_view tag, std::string_view name) const {
        const auto text = attribute(tag, name);
        if (!text) {
            return std::nullopt;
        }
        const auto value = to_integer(*text);
        if (!value || *value < 0 || static_cast<std::uint64_t>(*value) > source_.bytes.size()) {
            throw source_.error_at(
                line_, fmt::format("{}={} cannot be true of a file of {} bytes; remedy: export the mesh again", name,
                                   printable(*text), source_.bytes.size()));
        }
        return static_cast<std::uint64_t>(*value);
    }

    void check(const Accessor& accessor) const {
        const auto array = arrays_.find(accessor.array);
        if (array != arrays_.end() && accessor.end > array->second) {
            throw source_.error_at(accessor.line,
                                   fmt::format("the accessor needs {} values, but {} has {}; remedy: export the mesh "
                                               "again",
                                               accessor.end, printable(accessor.array), array->second));
        }
    }

    const Source& source_;
    std::size_t at_ = 0, line_ = 1;
    std::map<std::string_view, std::uint64_t> arrays_;
    std::vector<Accessor> accessors_;
};

} // namespace

void check_collada(const Source& source) {
    if (source.bytes.find("<COLLADA") == std::string::npos) {
        throw source.error("it holds no COLLADA: there is no element <COLLADA>");
    }
    ColladaCheck(source).run();
}

} // namespace foam::load_assimp
