// Colours that a URDF gives its visual elements.
#pragma once

#include <foam/view/subject.hpp>

#include <vector>

namespace foam::inline view {

/// Returns the colour of each visual of each link of the robot; nothing where there is none, or only a texture.
std::vector<std::vector<std::optional<Colour>>> material_colours(const Robot& robot);

} // namespace foam::inline view
