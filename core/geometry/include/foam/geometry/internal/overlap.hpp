// The part of a ball's surface outside other balls.
#pragma once

#include <foam/geometry/sphere.hpp>

#include <span>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// Writes the other balls that cut ball `i` into `near`. Returns false if one of them contains it entirely (of equal
/// balls the first counts).
bool overlapping(std::span<const Sphere> balls, std::size_t i, std::vector<Sphere>& near);

/// Returns whether `p` lies outside all of `near`.
inline bool exposed(const Vec3& p, std::span<const Sphere> near) {
    for (const Sphere& s : near) {
        if (squared_norm(p - s.center) < s.radius * s.radius) {
            return false;
        }
    }
    return true;
}

} // namespace geometry
} // namespace foam
