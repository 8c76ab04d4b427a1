// Changes to a text that keep every other byte.
#pragma once

#include <foam/geometry/sphere.hpp>

#include <foam/xml/document.hpp>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace foam {

/// Changes parts of a text. Changes may be added in any order, but must not overlap; each link's collisions only once.
class UrdfEditor {
public:
    explicit UrdfEditor(std::string_view text) : text_(text) {}

    void replace(const xml::Span& span, std::string replacement) { changes_.push_back({span, std::move(replacement)}); }
    /// Sets an attribute; `value` is fit for double quotes and for the attribute's own.
    void set_attribute(const xml::Element& element, std::string_view key, const std::string& value);
    /// Removes an element with the blanks and the line end before it.
    void remove(const xml::Element& element);
    /// Puts an element after the other children, indented as they are; in the same line if they are not on lines of
    /// their own.
    void append_child(const xml::Element& parent, std::string child);
    /// Replaces the <collision> elements of a <link> by spheres: the spheres take the place of the first one, one per
    /// line with its indentation (in the same line if it is not on a separate line). Comments between the elements
    /// stay. A link without <collision> gets the spheres as its last children. `properties`: elements that each
    /// <collision> gets besides.
    void replace_collisions(const xml::Element& link, const std::vector<Sphere>& spheres,
                            const std::string& properties = "");
    /// Returns the text with all changes.
    std::string result();

private:
    struct Change {
        xml::Span span;
        std::string replacement;
    };
    using Appended = std::pair<const xml::Element*, std::vector<std::string>>;

    void add_children(const Appended& appended);

    std::string_view text_;
    std::vector<Change> changes_;
    std::vector<Appended> appended_;
};

} // namespace foam
