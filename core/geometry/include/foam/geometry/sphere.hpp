// Spheres, approximations by spheres and other convex elements, and the guarantee of a model.
#pragma once

#include <foam/geometry/element.hpp>
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

/// Convex elements, seen as one set. Spheres are apart from other elements, because they have quick paths of their own.
struct ElementsView {
    std::span<const Sphere> spheres{};
    std::span<const Element> others{}; ///< of any kind; those of kind sphere are allowed

    std::size_t size() const { return spheres.size() + others.size(); }
    bool empty() const { return spheres.empty() && others.empty(); }
};

/// An approximation by convex elements, in levels from coarse to fine. Level 0 is one bounding sphere; every level
/// approximates the whole solid. A sphere tree is an approximation whose elements are all spheres.
struct Approximation {
    struct Level {
        std::vector<Sphere> spheres;
        /// Index of the parent of each element in the level above, spheres first, then other elements; there, too,
        /// indices count spheres first. Empty at level 0.
        std::vector<std::uint32_t> parents;
        std::vector<Element> others{}; ///< elements of other kinds than sphere

        bool operator==(const Level&) const = default;
        std::size_t size() const { return spheres.size() + others.size(); }
        ElementsView view() const { return {spheres, others}; }
    };
    std::vector<Level> levels;

    bool operator==(const Approximation&) const = default;
    /// The spheres of the finest level. Precondition: at least one level.
    const std::vector<Sphere>& finest() const { return levels.back().spheres; }
    /// All elements of the finest level. Precondition: at least one level.
    ElementsView elements() const { return levels.back().view(); }
};
using SphereTree = Approximation;

/// Returns a tree of two levels: a bounding sphere (of the spheres) over `spheres`.
SphereTree flat_tree(std::vector<Sphere> spheres);
/// Returns an approximation of two levels: a bounding sphere over spheres and other elements.
Approximation flat_approximation(std::vector<Sphere> spheres, std::vector<Element> others);
/// Returns the smallest sphere that contains all `points`, to about 1e-12 of its radius (Welzl 1991, Gärtner 1999),
/// grown until every point is inside. Without points: radius 0 at the origin. Expected O(n).
Sphere minimum_enclosing_sphere(std::span<const Vec3> points);
/// Returns a small sphere that contains both (exact for two balls).
Sphere enclosing_sphere(const Sphere& a, const Sphere& b);
/// Returns a small sphere that contains all spheres.
Sphere enclosing_sphere(const std::vector<Sphere>& spheres);

} // namespace geometry
} // namespace foam
