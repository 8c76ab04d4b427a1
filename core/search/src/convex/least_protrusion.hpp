// The element around points that protrudes least.
#pragma once

#include "cloud.hpp"

#include <foam/geometry/solid.hpp>
#include <foam/search/approximate.hpp>

namespace foam::inline search::convex {

/// Returns the element of the kind around the cloud that protrudes least, in the mean or at most, of those found by
/// descents from elements of little volume. All of the solid's surface must be in the hull of the cloud. Precondition:
/// the kind is neither hull nor sphere.
Fit least_protrusion(Element::Kind kind, const Cloud& cloud, const Solid& solid, ApproximationObjective objective,
                     Effort effort, bool axis_aligned);

} // namespace foam::inline search::convex
