// The robot from the elements of its URDF.
#pragma once

#include "reader.hpp"

#include <foam/robot/robot.hpp>
#include <foam/sdk/context.hpp>

namespace foam::urdf {

/// Returns the links and joints of <robot>, checked to be one tree; mesh paths are not resolved yet. `name`: for a
/// robot without one.
Robot read_robot(const xml::Element& root, const std::string& name, const Reader& reader, Context& context);

} // namespace foam::urdf
