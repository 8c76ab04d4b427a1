// Elements as <collision> elements of URDF, and back.
#pragma once

#include <foam/sdk/elements.hpp>
#include <foam/xml/document.hpp>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace foam {

/// The words for what plain URDF lacks.
struct UrdfWords {
    std::string capsule = "capsule"; ///< of URDF 1.1; Drake: "drake:capsule"
    bool declares_convex = false;    ///< Drake: meshes are said to be convex
    std::string properties{};        ///< elements that each <collision> gets besides
};

/// Returns the numbers with blanks between them, each with all its digits.
std::string three_numbers(const Vec3& v);

/// Returns the shape of an element that is centred at its origin: a sphere, box, cylinder or capsule.
std::string shape_text(const Element& element, const UrdfWords& words);

/// Returns the <collision> elements of a link's elements. `uri_of_hull`: the reference to the mesh of the next hull, as
/// text for an attribute.
std::vector<std::string> collision_elements(const LinkSpheres& link, const UrdfWords& words,
                                            const std::function<std::string()>& uri_of_hull);

/// Adds the element of a <collision> as another program computes it; meshes are looked up in `beside`, others left out.
/// Throws Error(output) for numbers that are none.
void add_collision(const xml::Element& collision, const std::map<std::string, std::string>& beside,
                   Elements& elements);

} // namespace foam
