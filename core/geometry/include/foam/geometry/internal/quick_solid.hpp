// Solids and figures where there is no time for the usual ones.
#pragma once

#include <foam/geometry/measure.hpp>
#include <foam/geometry/solid.hpp>

#include <memory>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// Returns the solid of these parts, whose meshes are interpreted on the first query that needs to know the inside, not
/// at once: proofs need nothing but the surface. Its surface is wound as given.
std::shared_ptr<const Solid> quick_solid(std::vector<Solid::Part> parts);

/// Returns bounds on the figures, in the time that a proof takes: as if the solid had no volume, so that all of the
/// elements is excess, and as if their surface were exposed as far from the solid as it can be, the diagonal of the box
/// around both.
Measures bounds_of_measures(const Solid& solid, const Elements& elements);

} // namespace geometry
} // namespace foam
