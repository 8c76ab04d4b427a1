// The elements of an XML text with their places, so that messages can name them and editors can replace them without
// any change to other bytes.
#pragma once

#include <foam/base/error.hpp>

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace foam {
namespace [[gnu::visibility("default")]] xml {

/// The bytes [begin, end) of the text.
struct Span {
    std::size_t begin = 0, end = 0;
    std::size_t size() const { return end - begin; }
};

/// An element. Strings are UTF-8 in any encoding of the text; names keep their namespace prefix.
struct Element {
    std::string name;
    std::vector<std::pair<std::string, std::string>> attributes;
    std::vector<std::unique_ptr<Element>> children;
    Span span;               ///< from "<name" to the end of "</name>" or "<name/>"
    Span start_tag;          ///< the whole element if it is self-closing
    std::size_t end_tag = 0; ///< where "</name>" begins; span.end if the element is self-closing
    int line = 0;            ///< 1-based

    bool self_closing() const { return start_tag.end == span.end; }
    /// Returns the attribute; nullptr if there is none.
    const std::string* attribute(std::string_view key) const;
    /// Returns the first child element of that name; nullptr if there is none.
    const Element* child(std::string_view child_name) const;
    std::vector<const Element*> children_named(std::string_view child_name) const;
    /// Returns the place of an attribute's value, between its quotes, in the text that the element was parsed from.
    /// Precondition: the attribute exists.
    Span attribute_span(std::string_view key, std::string_view text) const;
};

/// Parses a text. Throws Error(code) with "label:line:column: reason" if it is not well-formed, is UTF-16, declares or
/// uses its own entities (an edit could not resolve them), or is nested more than 200 deep.
std::unique_ptr<const Element> parse(std::string_view text, const std::string& label, ErrorCode code);

/// What keeps a text from being well-formed, and the remedy.
struct Fault {
    int line = 0; ///< 1-based
    std::string what;
};

/// Parses a text as the readers of the field do, and adds what it lacks to `faults`: blanks, NULs and byte order marks
/// may stand before the XML declaration, anything after the root element, "--" in comments, '&' that begin no entity (in
/// a text without "&#"); bytes may be of another encoding than the text says. Places are those in `text`. Throws as parse() for all else.
std::unique_ptr<const Element> parse_leniently(std::string_view text, const std::string& label, ErrorCode code,
                                               std::vector<Fault>& faults);

/// Returns the name of the root element, without parsing more than what is before it; empty if the text does not begin
/// like XML.
std::string_view root_name(std::string_view text);

/// Changes parts of a text. Changes may be added in any order, but must not overlap. The text and the elements that
/// were parsed from it must outlive the editor.
class Editor {
public:
    explicit Editor(std::string_view text) : text_(text) {}

    void replace(const Span& span, std::string replacement) { changes_.push_back({span, std::move(replacement)}); }
    /// Sets an attribute; `value` is fit for double quotes and for the attribute's own.
    void set_attribute(const Element& element, std::string_view key, const std::string& value);
    /// Removes an element with the blanks and the line end before it.
    void remove(const Element& element);
    /// Puts an element after the other children, indented as they are; in the same line if they are not on lines of
    /// their own.
    void append_child(const Element& parent, std::string child);
    /// Replaces elements of one parent by others: these take the place of the first one, one a line with its
    /// indentation (in the same line if it is not on a line of its own); comments between the elements stay. If there
    /// is nothing to replace, they become the last children of the parent.
    void replace_children(const Element& parent, const std::vector<const Element*>& old,
                          const std::vector<std::string>& children);
    /// Returns the text with all changes.
    std::string result();

private:
    struct Change {
        Span span;
        std::string replacement;
    };
    using Appended = std::pair<const Element*, std::vector<std::string>>;

    void add_children(const Appended& appended);

    std::string_view text_;
    std::vector<Change> changes_;
    std::vector<Appended> appended_;
};

} // namespace xml
} // namespace foam
