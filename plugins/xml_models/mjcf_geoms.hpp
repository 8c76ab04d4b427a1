// The geoms of an MJCF file with the attributes that default classes give them.
#pragma once

#include <foam/xml/document.hpp>

#include <string>
#include <vector>

namespace foam::xml_models {

struct MjcfGeom {
    const xml::Element* geom = nullptr;
    const xml::Element* body = nullptr;  ///< or the <worldbody>
    bool sphere = false;                 ///< a geom without type is one, unless its class or a mesh says otherwise
    bool collides = true;                ///< contype or conaffinity is not 0
    const xml::Element* sized = nullptr; ///< the element with its size: itself or the <geom> of a class; null: none
};

/// Returns the geoms in the order of the file. Throws Error(input) for a default class that does not exist.
std::vector<MjcfGeom> geoms_of(const xml::Element& root, const std::string& file);

/// Returns the name of a body: "world" for the <worldbody>, "" for one without a name.
std::string name_of_body(const xml::Element& body);

} // namespace foam::xml_models
