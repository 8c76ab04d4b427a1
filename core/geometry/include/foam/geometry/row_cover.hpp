// Covering spheres in closed form for round primitives.
#pragma once

#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>

#include <optional>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// Equal balls in a row along an axis: the parameters of their union.
struct BallRow {
    std::size_t count = 1;
    double radius = 0;
    double half_spacing = 0; ///< half the distance of neighbours; less than the radius
    /// Returns the volume of the union. Each ball ends where it meets its neighbour, which leaves a zone of two bases;
    /// the ends are caps.
    double volume() const;
};

/// Returns the row of least radius whose `count` balls contain a cylinder. Where neighbours meet they must reach the
/// wall, and the outer ones the rims of the discs: with h = length / (2 count), r² = radius² + h².
BallRow row_around_cylinder(double radius, double length, std::size_t count);

/// Returns the row of least radius whose `count` balls contain a capsule: all points within `radius` of a segment of
/// `length`. Neighbours meet at the wall, r² = radius² + h²; the outer ones touch the poles, r = radius + e, with
/// centres e inwards of the segment's ends: length = 2 e + 2 h (count - 1). Michaux et al., SPARROWS (RSS 2024), cover
/// tapered capsules in the same way.
BallRow row_around_capsule(double radius, double length, std::size_t count);

/// Returns, if the solid is one cylinder or capsule, the row of at most `most` balls with the least volume that
/// contains its surface, which is the polyhedron around it; nothing otherwise. O(most).
std::optional<std::vector<Sphere>> row_cover(const Solid& solid, std::size_t most);

} // namespace geometry
} // namespace foam
