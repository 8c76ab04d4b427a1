// Volumes of unions of elements, and the mass of a solid.
#pragma once

#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>

#include <array>
#include <optional>
#include <span>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// Returns the volume of the union, m³, exact to rounding. It can tell two sets of spheres with nearly equal volumes
/// apart. Spheres that are not finite or have no radius count as absent. O(n · k²) for k overlapping neighbours per
/// sphere; union_volume() is quicker where hundreds overlap.
double exact_union_volume(std::span<const Sphere> spheres);

/// Returns vol(S ∪ U), m³: the excess volume of U is that minus vol(S). A cavity that the spheres leave in the solid
/// brings no advantage. vol(U) is exact; the missing volume is integrated along the solid's lines, which are the same
/// for all spheres.
inline double joint_volume(const Solid& solid, std::span<const Sphere> spheres) {
    return exact_union_volume(spheres) + solid.missing_volume(spheres);
}

/// Mass properties of a solid of one density.
struct MassProperties {
    double mass = 0;                 ///< kg
    Vec3 center;                     ///< m, in the solid's frame
    std::array<double, 6> inertia{}; ///< about the centre, kg m²: xx, yy, zz, xy, xz, yz
};

/// Returns the mass properties at a density, kg/m³. They are exact for closed parts that do not overlap, otherwise
/// integrated along lines, with a relative error of about 1e-3; of a mesh that is not closed, those of the points
/// inside by its winding number. Nothing for a solid without volume.
std::optional<MassProperties> mass_properties(const Solid& solid, double density);

} // namespace geometry
} // namespace foam
