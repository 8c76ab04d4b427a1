// Spheres, sphere trees and the guarantee of a model.
#pragma once

#include <foam/geometry/vector.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// A ball: all points within `radius` of `center`. Metres; link frame.
struct Sphere {
    Vec3 center;
    double radius = 0;

    bool operator==(const Sphere&) const = default;
};

/// What is proved of the spheres U of a solid S.
enum class Guarantee {
    outer,  ///< S ⊂ U, proved: the spheres cover the geometry
    inner,  ///< U ⊂ S, proved: the spheres lie inside the geometry
    fitted, ///< neither; the figures say how close the spheres are
};

/// Spheres in levels from coarse to fine. Level 0 is one bounding sphere; every level approximates the whole solid.
struct SphereTree {
    struct Level {
        std::vector<Sphere> spheres;
        /// Index of the parent of each sphere in the level above; empty at level 0.
        std::vector<std::uint32_t> parents;

        bool operator==(const Level&) const = default;
    };
    std::vector<Level> levels;

    bool operator==(const SphereTree&) const = default;
    /// The finest level. Precondition: at least one level.
    const std::vector<Sphere>& finest() const { return levels.back().spheres; }
};

/// Returns a tree of two levels: a bounding sphere (of the spheres) over `spheres`.
SphereTree flat_tree(std::vector<Sphere> spheres);
/// Returns the smallest sphere that contains all `points`, to about 1e-12 of its radius (Welzl 1991, Gärtner 1999),
/// grown until every point is inside. Without points: radius 0 at the origin. Expected O(n).
Sphere minimum_enclosing_sphere(std::span<const Vec3> points);
/// Returns a small sphere that contains both (exact for two balls).
Sphere enclosing_sphere(const Sphere& a, const Sphere& b);
/// Returns a small sphere that contains all spheres.
Sphere enclosing_sphere(const std::vector<Sphere>& spheres);

} // namespace geometry
} // namespace foam
