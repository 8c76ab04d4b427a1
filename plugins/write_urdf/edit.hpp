// Changes to a text that leave every other byte as it is.
#pragma once

#include <foam/sphere.hpp>
#include <xml/document.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace foam {

/// Changes parts of a text. Of a <link> it replaces the <collision> elements by spheres: the spheres take the place of
/// the first one, one a line with its indentation (in the same line if it does not stand on a line of its own).
/// Comments between the elements stay. A link without <collision> gets the spheres as its last children.
class UrdfEditor {
public:
    explicit UrdfEditor(std::string_view text) : text_(text) {}

    void replace(const xml::Span& span, std::string replacement) { changes_.push_back({span, std::move(replacement)}); }
    void replace_collisions(const xml::Element& link, const std::vector<Sphere>& spheres);
    /// The text with all changes. They may be given in any order, but must not overlap; a link only once.
    std::string result();

private:
    struct Change {
        xml::Span span;
        std::string replacement;
    };

    std::string_view text_;
    std::vector<Change> changes_;
};

} // namespace foam
