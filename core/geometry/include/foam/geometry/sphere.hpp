// Spheres, approximations by spheres and other convex elements, and the guarantee of a model.
#pragma once

#include <foam/geometry/elements.hpp>
#include <foam/geometry/vector.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// What is proved of the spheres U of a solid S.
enum class Guarantee {
    outer,  ///< S ⊂ U, proved: the spheres cover the geometry
    inner,  ///< U ⊂ S, proved: the spheres lie inside the geometry
    fitted, ///< neither; the figures say how close the spheres are
};

/// An approximation by convex elements, in levels from coarse to fine. Level 0 is one bounding sphere; every level
/// approximates the whole solid. A sphere tree is an approximation whose elements are all spheres.
struct Approximation {
    struct Level {
        Elements elements;
        /// Index of the parent of each element in the level above. Empty at level 0.
        std::vector<std::uint32_t> parents{};

        bool operator==(const Level&) const = default;
    };
    std::vector<Level> levels;

    bool operator==(const Approximation&) const = default;
    /// The elements of the finest level. Precondition: at least one level.
    const Elements& elements() const { return levels.back().elements; }
    /// The spheres of the finest level. Precondition: at least one level.
    const std::vector<Sphere>& finest() const { return elements().spheres(); }
};
using SphereTree = Approximation;

/// Returns an approximation of two levels: a bounding sphere over the elements.
Approximation flat_tree(Elements elements);
/// Returns the smallest sphere that contains all `points`, to about 1e-12 of its radius (Welzl 1991, Gärtner 1999),
/// grown until every point is inside. Without points: radius 0 at the origin. Expected O(n).
Sphere minimum_enclosing_sphere(std::span<const Vec3> points);
/// Returns a small sphere that contains both (exact for two balls).
Sphere enclosing_sphere(const Sphere& a, const Sphere& b);
/// Returns a small sphere that contains all spheres.
Sphere enclosing_sphere(const std::vector<Sphere>& spheres);

} // namespace geometry
} // namespace foam
