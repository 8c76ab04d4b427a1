// Polygons as triangles.
#pragma once

#include "vector.hpp"

#include <vector>

namespace judge {

/// Appends the triangles of a plane polygon, convex or not, whose sides do not cross: ears are cut off one after the
/// other. A convex one becomes the fan of its first corner, as does what is left of one without ears, which is not plane.
void append_polygon(std::vector<Point> corners, std::vector<Corners>& triangles);

} // namespace judge
