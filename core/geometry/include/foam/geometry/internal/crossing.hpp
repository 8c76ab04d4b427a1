// Whether two triangles pass through each other.
#pragma once

#include <foam/geometry/vector.hpp>

#include <array>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

using TriangleCorners = std::array<Vec3, 3>;

/// Returns whether a side of one triangle passes through the interior of the other, as far as orientation tests in
/// double precision are certain of their sign (Shewchuk: Adaptive Precision Floating-Point Arithmetic, 1997,
/// section 4.3), even if every coordinate is off by a unit in the last place. `shared`: corners that are corners of the
/// other triangle; it is only touched there.
bool side_passes_through(const TriangleCorners& sides, const TriangleCorners& other,
                         const std::array<bool, 3>& shared = {});

} // namespace geometry
} // namespace foam
