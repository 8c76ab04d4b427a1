// Points where balls do not cover a surface.
#pragma once

#include "cover/measured/points.hpp"

namespace foam::inline search::cover {

/// Returns the middles of the pieces that no single ball contains, with edges of about `finest` (unit frame). They
/// concentrate where the surface runs through the creases between balls, and where it extends beyond them. At most
/// `most`.
Points crease_points(const Solid& solid, const Frame& frame, const Balls& balls, double finest, std::size_t most);

} // namespace foam::search::cover
