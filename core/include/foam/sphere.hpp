// Spheres, sphere trees and the guarantee a model gives.
#pragma once

#include <foam/vector.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace foam {

/// A ball: all points within `radius` of `center`. Metres; the frame is the link's.
struct Sphere {
    Vec3 center;
    double radius = 0;

    bool operator==(const Sphere&) const = default;
};

/// What is promised of the spheres U of a solid S.
enum class Guarantee {
    outer,  ///< S ⊂ U, proved: nothing of the geometry sticks out
    inner,  ///< U ⊂ S: no free space is claimed
    fitted, ///< neither; the measures say how far off
};

/// Spheres in levels from coarse to fine. Level 0 is one bounding sphere; every level stands for the whole solid.
struct SphereTree {
    struct Level {
        std::vector<Sphere> spheres;
        /// For each sphere the index of its parent in the level above; empty at level 0.
        std::vector<std::uint32_t> parents;

        bool operator==(const Level&) const = default;
    };
    std::vector<Level> levels;

    bool operator==(const SphereTree&) const = default;
    /// The finest level. Precondition: at least one level.
    const std::vector<Sphere>& finest() const { return levels.back().spheres; }
};

/// A tree of two levels: a bounding sphere (of the spheres) over `spheres`.
SphereTree flat_tree(std::vector<Sphere> spheres);
/// A small sphere that holds all `points`: exact minimum to rounding (Welzl 1991), grown until every point is inside.
/// No points: radius 0 at the origin. Expected O(n).
Sphere minimum_enclosing_sphere(const std::vector<Vec3>& points);
/// A small sphere that holds both (exact for two balls).
Sphere enclosing_sphere(const Sphere& a, const Sphere& b);
/// A small sphere that holds all spheres.
Sphere enclosing_sphere(const std::vector<Sphere>& spheres);

} // namespace foam
