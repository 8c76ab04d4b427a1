// Colours of OBJ materials, which lie in files of their own (MTL).
#pragma once

#include "text.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <string>

namespace foam::load_mesh {

/// Returns the diffuse colours (Kd, d), 0xRRGGBBAA, of the materials in the files that an OBJ names in its folder; none
/// of a file that cannot be read.
std::map<std::string, std::uint32_t, std::less<>> obj_colours(const Source& obj);

} // namespace foam::load_mesh
