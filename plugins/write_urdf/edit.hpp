// Changes to a text that keep every other byte.
#pragma once

#include <foam/geometry/sphere.hpp>

#include <foam/xml/document.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace foam {

/// Changes parts of a text. Replaces the <collision> elements of a <link> by spheres: the spheres take the place of the
/// first one, one per line with its indentation (in the same line if it is not on a separate line). Comments between
/// the elements stay. A link without <collision> gets the spheres as its last children.
class UrdfEditor {
public:
    explicit UrdfEditor(std::string_view text) : text_(text) {}

    void replace(const xml::Span& span, std::string replacement) { changes_.push_back({span, std::move(replacement)}); }
    void replace_collisions(const xml::Element& link, const std::vector<Sphere>& spheres);
    /// Returns the text with all changes. They may be added in any order, but must not overlap; each link only once.
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
