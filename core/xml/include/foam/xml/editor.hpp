// Changes to an XML text that keep every other byte.
#pragma once

#include <foam/xml/document.hpp>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace foam {
namespace [[gnu::visibility("default")]] xml {

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
