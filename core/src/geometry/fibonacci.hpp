// Directions spread evenly over the sphere, and what other balls leave of a ball's surface.
#pragma once

#include <foam/sphere.hpp>

#include <span>
#include <vector>

namespace foam::geometry {

/// `count` unit vectors on the Fibonacci lattice, each for the same share of the sphere (González 2010, with the offset
/// of one half at the poles).
std::vector<Vec3> fibonacci_directions(std::size_t count);

/// The other balls that cut ball `i` into `near`; false if one of them holds it whole (of equal balls the first
/// counts).
bool overlapping(std::span<const Sphere> balls, std::size_t i, std::vector<Sphere>& near);

/// Whether `p` lies outside all of `near`.
inline bool exposed(const Vec3& p, std::span<const Sphere> near) {
    for (const Sphere& s : near) {
        if (squared_norm(p - s.center) < s.radius * s.radius) {
            return false;
        }
    }
    return true;
}

} // namespace foam::geometry
