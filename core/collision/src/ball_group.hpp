// The elements of a link with one sphere that contains them all.
#pragma once

#include <foam/geometry/sphere.hpp>

#include <vector>

namespace foam::inline collision::self_collision {

/// An element that is no sphere, with a sphere around it.
struct BoundedElement {
    Element element;
    Sphere bound;
};

struct BallGroup {
    Sphere bound;
    std::vector<Sphere> spheres;
    std::vector<BoundedElement> shaped; ///< elements that are no spheres

    /// Precondition: there is at least one element.
    explicit BallGroup(const Elements& elements) : spheres(elements.spheres()) {
        std::vector<Sphere> all = spheres;
        for (const Element& element : elements.shaped()) {
            shaped.push_back({element, minimum_enclosing_sphere(enclosing_mesh(element).vertices)});
            all.push_back(shaped.back().bound);
        }
        bound = enclosing_sphere(all);
    }
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

/// Returns whether elements of two links touch. O(n · m) in the elements near the other link.
bool touch(const BallGroup& a, const Pose& pose_a, const BallGroup& b, const Pose& pose_b);
/// Returns the same of those pairs of elements of which at least one is no sphere.
bool shaped_touch(const BallGroup& a, const Pose& pose_a, const BallGroup& b, const Pose& pose_b);

} // namespace foam::collision::self_collision
