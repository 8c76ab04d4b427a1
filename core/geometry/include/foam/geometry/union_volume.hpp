// Volume of a union of balls in closed form.
#pragma once

#include <foam/geometry/sphere.hpp>

#include <span>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// Returns the volume of the union, m³, exact to rounding. It can tell two sets of spheres with nearly equal volumes
/// apart. Spheres that are not finite or have no radius count as absent. O(n · k²) for k overlapping neighbours per
/// sphere; union_volume() is quicker where hundreds overlap.
double exact_union_volume(std::span<const Sphere> spheres);

} // namespace geometry
} // namespace foam
