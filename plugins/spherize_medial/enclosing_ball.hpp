// The smallest enclosing ball of many points, for the inner loops.
#pragma once

#include <foam/geometry/sphere.hpp>

#include <span>

namespace foam::medial {

/// Returns the smallest ball that contains all points, to about 1e-12 of its radius: the farthest point joins a small
/// support set until none is outside (the pivoting of Gärtner 1999). About ten passes over the points. No points:
/// radius 0.
Sphere enclosing_ball(std::span<const Vec3> points);

} // namespace foam::medial
