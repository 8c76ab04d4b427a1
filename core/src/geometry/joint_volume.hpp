// The volume that spheres and a solid take together.
#pragma once

#include <foam/solid.hpp>
#include <foam/union_volume.hpp>

namespace foam::geometry {

/// vol(S ∪ U), m³: what spheres U claim of their own is that less vol(S). A hollow that they leave in the solid is no
/// gain. vol(U) is exact, what is missing is found along the solid's lines: the same for all spheres.
inline double joint_volume(const Solid& solid, std::span<const Sphere> spheres) {
    return exact_union_volume(spheres) + solid.missing_volume(spheres);
}

} // namespace foam::geometry
