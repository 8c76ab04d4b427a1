// Solids of points with radii: what a sensor saw, and how far off it may be.
#pragma once

#include <foam/geometry/elements.hpp>
#include <foam/geometry/solid.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// Returns the union of balls. Balls within others are left out, so that equal points count once. A radius of 0 becomes
/// a millionth of the size of all of them: a point has no volume. O(n log n) but for balls that overlap much. Throws
/// Error(geometry) without balls, for a number that is not finite and for a negative radius.
std::shared_ptr<const Solid> solid_of_balls(std::span<const Sphere> balls);
/// Throws Error(geometry) where solid_of_balls() does.
void require_balls(std::span<const Sphere> balls);
/// Returns the balls of a solid that is made of no more than `most` balls and of nothing else; nothing for any other.
std::optional<std::vector<Sphere>> balls_of(const Solid& solid, std::size_t most);

} // namespace geometry
} // namespace foam
