#include "collada.hpp"

#include <foam/base/text.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace foam::load_mesh {
namespace {

/// Repairs frequent errors of exporters without moving any byte, so that places stay right: bytes that are not UTF-8,
/// and an XML declaration after the start of the file.
std::string repaired(std::string_view text) {
    std::string result = with_valid_utf8(text);
    const std::size_t start = text.find_first_not_of(" \t\r\n");
    if (start != 0 && start != text.npos && text.substr(start).starts_with("<?xml ")) {
        const std::size_t end = std::min(text.find("?>", start), text.size() - 2) + 2;
        for (std::size_t at = start; at < end; ++at) {
            result[at] = result[at] == '\n' ? '\n' : ' ';
        }
    }
    return result;
}

bool has_another_encoding(std::string_view text) {
    const std::string_view declaration = text.substr(0, text.find("?>"));
    const std::size_t at = declaration.find("encoding=");
    return declaration.starts_with("<?xml") && at != declaration.npos &&
           !lower_case(declaration.substr(at, 17)).ends_with("utf-8");
}

std::unique_ptr<const xml::Element> parsed(const Source& source) {
    const std::string& text = source.bytes;
    const std::string label = source.file.string();
    return has_another_encoding(text) ? xml::parse(text, label, ErrorCode::input)
                                      : xml::parse(repaired(text), label, ErrorCode::input);
}

std::size_t text_end(const xml::Element& element) {
    return element.self_closing() ? element.start_tag.end : element.end_tag;
}

} // namespace

ColladaDocument::ColladaDocument(const Source& source) : source_(source) {
    if (source.bytes.find("COLLADA") == std::string::npos && !source.bytes.starts_with("\xFE\xFF") &&
        !source.bytes.starts_with("\xFF\xFE")) {
        throw source.error("it holds no COLLADA: there is no element <COLLADA>");
    }
    root_ = parsed(source);
    if (root_->name != "COLLADA") {
        throw source.error("it holds no COLLADA: there is no element <COLLADA>");
    }
    index(*root_);
}

void ColladaDocument::index(const xml::Element& element) {
    if (const std::string* id = element.attribute("id")) {
        ids_.try_emplace(*id, &element);
    }
    for (const auto& child : element.children) { // at most as deep as xml::parse() allows
        index(*child);
    }
}

const xml::Element* ColladaDocument::target(const xml::Element& from, std::string_view key) const {
    const std::string* reference = from.attribute(key);
    if (!reference || !reference->starts_with('#')) {
        return nullptr;
    }
    const auto it = ids_.find(std::string_view(*reference).substr(1));
    return it == ids_.end() ? nullptr : it->second;
}

Error ColladaDocument::error(const xml::Element& element, std::string_view what) const {
    return source_.error_at(static_cast<std::size_t>(element.line), what);
}

ElementWords::ElementWords(const Source& source, const xml::Element& element)
    : source_(source), element_(element),
      words_(source, element.start_tag.end, text_end(element),
             static_cast<std::size_t>(element.line) +
                 static_cast<std::size_t>(
                     std::count(source.bytes.begin() + static_cast<std::ptrdiff_t>(element.start_tag.begin),
                                source.bytes.begin() + static_cast<std::ptrdiff_t>(element.start_tag.end), '\n')),
             0) {}

std::string_view ElementWords::next() {
    std::string_view word = words_.next();
    while (word.starts_with("<!--")) {
        while (!word.empty() && !word.ends_with("-->")) {
            word = words_.next();
        }
        word = words_.next();
    }
    return word;
}

Error ElementWords::error(std::string_view what) const {
    return source_.error_at(words_.line(), fmt::format("<{}> {}; remedy: export the mesh again", element_.name, what));
}

std::optional<double> ElementWords::number() {
    const std::string_view word = next();
    if (word.empty()) {
        return std::nullopt;
    }
    const auto value = to_number(word);
    if (!value) {
        throw error(fmt::format("holds {}, which is no number", printable(word)));
    }
    return value;
}

std::optional<std::uint32_t> ElementWords::index() {
    const std::string_view word = next();
    if (word.empty()) {
        return std::nullopt;
    }
    const auto value = to_integer(word);
    if (!value || *value < 0 || *value > std::numeric_limits<std::uint32_t>::max()) {
        throw error(fmt::format("holds {}, which is no index", printable(word)));
    }
    return static_cast<std::uint32_t>(*value);
}

} // namespace foam::load_mesh
