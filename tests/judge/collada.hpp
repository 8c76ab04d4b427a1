#pragma once

#include "vector.hpp"

#include <string>
#include <vector>

namespace judge {

/// Triangles, polygons and polygon lists of all geometry that the scene's nodes place, in metres; the up-axis is
/// ignored, as ROS does. Throws std::runtime_error.
std::vector<Corners> read_collada(const std::string& text);

} // namespace judge
