// The rectangle of least area around points of a plane.
#pragma once

#include "circle.hpp"

#include <vector>

namespace foam::inline search::convex {

struct Rectangle {
    Vec2 along{1, 0}; ///< unit direction of one side
    double area = 0;
};

/// Returns the rectangle of least area among those with a side along an edge of the points' hull, which has the least
/// one (Freeman and Shapira 1975). Sides count as at least `least` long. The points are sorted, and some dropped.
/// O(n log n); where corners of the hull coincide but for rounding, O(n log n + h²) for h of them.
Rectangle least_rectangle(std::vector<Vec2>& points, double least);

} // namespace foam::inline search::convex
