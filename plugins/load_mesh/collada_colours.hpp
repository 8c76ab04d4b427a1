// Colours of COLLADA materials.
#pragma once

#include "collada_document.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace foam::load_mesh {

/// Returns the diffuse colours, 0xRRGGBBAA, of materials that an <instance_geometry> or <instance_controller> binds to
/// names; 0 for one that is not bound, or has only a texture.
std::vector<std::uint32_t> colours_of(const ColladaDocument& document, const xml::Element& instance,
                                      const std::vector<std::string>& names);

} // namespace foam::load_mesh
