// Volume of a union of balls in closed form.
#pragma once

#include <foam/sphere.hpp>

#include <span>

namespace foam {

/// Volume of the union, m³, to rounding: fit for telling two sets of spheres apart that claim nearly the same. Spheres
/// that are not finite or have no radius count as absent. O(n · k²) for k overlapping neighbours a sphere;
/// union_volume() is quicker where hundreds overlap.
double exact_union_volume(std::span<const Sphere> spheres);

} // namespace foam
