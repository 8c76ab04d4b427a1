// Points outside a box about the origin.
#pragma once

#include <foam/geometry/vector.hpp>

namespace foam::inline geometry {

/// Returns the vector from the box [-half, half] to the point; zero inside.
inline Vec3 outside_box(const Vec3& half, const Vec3& p) {
    return {p.x - std::clamp(p.x, -half.x, half.x), p.y - std::clamp(p.y, -half.y, half.y),
            p.z - std::clamp(p.z, -half.z, half.z)};
}

} // namespace foam::geometry
