// Evenly spread unit vectors.
#pragma once

#include <foam/geometry/vector.hpp>

#include <numbers>
#include <vector>

namespace foam::medial {

/// Returns the spherical Fibonacci lattice (González 2010): `count` directions of nearly equal solid angle.
inline std::vector<Vec3> fibonacci_directions(std::size_t count) {
    constexpr double golden_angle = std::numbers::pi * (3 - 2.23606797749978969641);
    std::vector<Vec3> directions;
    directions.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(count);
        const double rho = std::sqrt(1 - z * z), angle = golden_angle * static_cast<double>(i);
        directions.push_back({rho * std::cos(angle), rho * std::sin(angle), z});
    }
    return directions;
}

} // namespace foam::medial
