// <link> elements, with their masses and materials.
#pragma once

#include "reader.hpp"

#include <foam/robot/robot.hpp>
#include <foam/sdk/context.hpp>

namespace foam::urdf {

/// Returns the materials of <robot> and of visuals, whose names others may use before them.
std::map<std::string, Material> materials_by_name(const xml::Element& root);
/// Returns the link; a visual that cannot be read is left out with a warning.
Link read_link(const xml::Element& element, const std::map<std::string, Material>& materials, const Reader& reader,
               Context& context);

} // namespace foam::urdf
