// The smallest circle around points of a plane.
#pragma once

#include <span>

namespace foam::inline search::convex {

struct Vec2 {
    double x = 0, y = 0;
};
struct Circle {
    Vec2 center;
    double radius = 0;
};

/// Returns the smallest circle that contains the points, at least one, to rounding. The farthest point outside enters
/// the basis until there is none (the pivot rule of Gärtner 1999).
Circle smallest_circle(std::span<const Vec2> points);

} // namespace foam::inline search::convex
