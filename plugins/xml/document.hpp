// The elements of an XML text, each with the place where it stands, so that messages can name it and editors can
// replace it without touching a byte of anything else.
#pragma once

#include <foam/error.hpp>

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace foam::xml {

/// The bytes [begin, end) of the text.
struct Span {
    std::size_t begin = 0, end = 0;
    std::size_t size() const { return end - begin; }
};

/// An element. Strings are UTF-8 whatever the encoding of the text; names keep their namespace prefix.
struct Element {
    std::string name;
    std::vector<std::pair<std::string, std::string>> attributes;
    std::vector<std::unique_ptr<Element>> children;
    Span span;               ///< from "<name" to the end of "</name>" or "<name/>"
    Span start_tag;          ///< the whole element if it is self-closing
    std::size_t end_tag = 0; ///< where "</name>" begins; span.end if the element is self-closing
    int line = 0;            ///< 1-based

    bool self_closing() const { return start_tag.end == span.end; }
    /// nullptr when there is none.
    const std::string* attribute(std::string_view key) const;
    /// The first child element of that name; nullptr when there is none.
    const Element* child(std::string_view child_name) const;
    std::vector<const Element*> children_named(std::string_view child_name) const;
    /// Where the value of an attribute that is there stands in the text that the element was parsed from, between its
    /// quotes.
    Span attribute_span(std::string_view key, std::string_view text) const;
};

/// Throws Error(code) with "label:line:column: reason" for text that is not well-formed, is UTF-16, declares or uses
/// entities of its own (an edit could not tell what they stand for), or is nested more than 200 deep.
std::unique_ptr<const Element> parse(std::string_view text, const std::string& label, ErrorCode code);

} // namespace foam::xml
