// As much of XML as URDF and COLLADA files take.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace judge {

struct Element {
    std::string name; ///< without a namespace
    std::map<std::string, std::string> attributes;
    std::vector<Element> children;
    std::string text; ///< all character data between the children

    /// The first child of that name; nullptr if there is none.
    const Element* child(const std::string& wanted) const;
    /// Throws std::runtime_error if there is none.
    const Element& at(const std::string& wanted) const;
    std::string attribute(const std::string& wanted, const std::string& otherwise = "") const;
};

/// The root element. Throws std::runtime_error.
Element parse_xml(const std::string& text);

} // namespace judge
