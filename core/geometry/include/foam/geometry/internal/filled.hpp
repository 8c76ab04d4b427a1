// Hollow geometry with its inside filled.
#pragma once

#include <foam/geometry/solid.hpp>

#include <memory>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// Returns the solid united with its inside: with the cells of a grid from which most lines meet the solid on both
/// sides (ray stabbing of Nooruddin and Turk 2003, with a majority in place of all lines, so that holes in a wall do
/// not matter). The same solid if there is no such cell. A cell has 1/48 of the longest edge of the solid's box; cells
/// that meet the surface are left out, so the filled inside is smaller than the true one. Lines go from cell to cell: a
/// hole in a wall that is narrower than a cell may be closed to them. A sheet without volume meets no line.
std::shared_ptr<const Solid> filled(const std::shared_ptr<const Solid>& solid);

} // namespace geometry
} // namespace foam
