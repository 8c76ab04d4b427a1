// <collision> and <visual> elements.
#pragma once

#include "reader.hpp"

#include <foam/robot/robot.hpp>

namespace foam::urdf {

/// Returns the element with its pose and geometry; mesh paths are not resolved yet. Supports all shapes of the URDF
/// specification, and capsules (Bullet, Drake, MuJoCo: `length` without the caps). Fails on anything else, and on sizes
/// that give no solid.
GeometryElement read_geometry_element(const xml::Element& element, const Reader& reader);

} // namespace foam::urdf
