// The spheres of a link with one sphere that contains them all.
#pragma once

#include <foam/geometry/sphere.hpp>

#include <vector>

namespace foam::inline collision::self_collision {

struct BallGroup {
    Sphere bound;
    std::vector<Sphere> spheres; ///< at least one

    explicit BallGroup(std::vector<Sphere> all) : bound(enclosing_sphere(all)), spheres(std::move(all)) {}
};

/// Returns the distance between the surfaces, m; negative where the spheres overlap.
inline double gap(const Sphere& a, const Sphere& b) {
    return distance(a.center, b.center) - a.radius - b.radius;
}

/// Returns whether the balls have a common point.
inline bool touch(const Sphere& a, const Sphere& b) {
    const double reach = a.radius + b.radius;
    return squared_norm(a.center - b.center) <= reach * reach;
}

inline Sphere moved(const Pose& pose, const Sphere& sphere) {
    return {pose * sphere.center, sphere.radius};
}

} // namespace foam::collision::self_collision
