// The volume of the union of spheres and a solid.
#pragma once

#include <foam/geometry/solid.hpp>
#include <foam/geometry/union_volume.hpp>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// Returns vol(S ∪ U), m³: the excess volume of U is that minus vol(S). A cavity that the spheres leave in the solid
/// brings no advantage. vol(U) is exact; the missing volume is integrated along the solid's lines, which are the same
/// for all spheres.
inline double joint_volume(const Solid& solid, std::span<const Sphere> spheres) {
    return exact_union_volume(spheres) + solid.missing_volume(spheres);
}

} // namespace geometry
} // namespace foam
