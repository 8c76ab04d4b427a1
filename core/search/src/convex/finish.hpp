// From pieces in units to certified elements in metres.
#pragma once

#include <foam/search/approximate.hpp>

namespace foam::inline search::convex {

/// Returns a hull around points that need not span space, larger by a billionth of their size and, where it would be
/// thinner, a millionth thick. At most `most_vertices` vertices, where that is more than 3.
Element hull_around(std::vector<Vec3> points, double unit, std::size_t most_vertices);

/// Returns the elements, grown where the proof asks for it, with their proof; their volume is left to the caller.
ConvexCover proved(const Solid& solid, Elements elements);

/// Returns the figure that the objective compares: m³ of excess volume, or m of protrusion.
double figure_of(const Solid& solid, const ConvexCover& cover, ApproximationObjective objective);

} // namespace foam::inline search::convex
