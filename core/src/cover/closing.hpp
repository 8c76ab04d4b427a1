// Where balls do not hold a surface, triangle by triangle, and radii that do.
#pragma once

#include "cover/points.hpp"

namespace foam::cover {

/// Corners of the pieces that no single ball holds, at edges of about `finest` (unit frame): these crowd where the
/// surface runs through the creases between balls, and where it sticks out. At most `most`.
Points crease_points(const Solid& solid, const Frame& frame, const Balls& balls, double finest, std::size_t most);

/// Spheres (solid's frame) grown until pieces with edges of `finest` metres are held by one of them each: the pieces
/// that are not go to the ball that has to grow least. Others stay as they are.
std::vector<Sphere> closed(const Solid& solid, std::vector<Sphere> spheres, double finest);

} // namespace foam::cover
