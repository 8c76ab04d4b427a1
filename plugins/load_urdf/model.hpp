// The robot as the elements of its URDF describe it.
#pragma once

#include "reader.hpp"

#include <foam/context.hpp>
#include <foam/robot.hpp>

namespace foam::urdf {

/// Links and joints of <robot>, checked to be one tree; mesh paths are not resolved yet. `name` if the robot has none.
Robot read_robot(const xml::Element& root, const std::string& name, const Reader& reader, Context& context);

} // namespace foam::urdf
