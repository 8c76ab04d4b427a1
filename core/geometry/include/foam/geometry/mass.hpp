// Volume, centre of mass and inertia of solids.
#pragma once

#include <foam/geometry/solid.hpp>

#include <array>
#include <optional>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

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
