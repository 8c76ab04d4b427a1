// The best point beyond some planes: a linear programme in three variables.
#pragma once

#include <foam/geometry/vector.hpp>

#include <optional>
#include <span>

namespace foam::inline search::convex {

/// The points x with dot(normal, x) >= offset, and how much the distance from its plane costs.
struct HalfSpace {
    Vec3 normal; ///< of length 1
    double offset;
    double weight; ///< at least 0
};

/// Returns the point in all half-spaces, to 1e-10, for which the sum of weight · distance from the plane is least.
/// Nothing if there is none with coordinates up to `reach`, or none that is well determined. The dual simplex method
/// (Lemke 1954): a handful of steps, each O(n).
std::optional<Vec3> least_beyond(std::span<const HalfSpace> planes, double reach);

} // namespace foam::inline search::convex
