// Where balls do not hold a surface.
#pragma once

#include "cover/points.hpp"

namespace foam::cover {

/// Corners of the pieces that no single ball holds, at edges of about `finest` (unit frame): these crowd where the
/// surface runs through the creases between balls, and where it sticks out. At most `most`.
Points crease_points(const Solid& solid, const Frame& frame, const Balls& balls, double finest, std::size_t most);

} // namespace foam::cover
