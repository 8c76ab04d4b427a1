// The distance of two convex elements, or the depth to which they overlap.
#pragma once

#include <foam/geometry/element.hpp>
#include <foam/geometry/sphere.hpp>

namespace foam {
inline namespace [[gnu::visibility("default")]] collision {

/// Bounds for two elements. At most one of them is above 0.
struct Separation {
    /// m; their distance is at least this; 0 where they touch or may touch.
    double low = 0;
    /// m; they still touch after they have moved against each other by less than this: from below, exact for two
    /// spheres; 0 where they are apart.
    double depth = 0;
};

/// Returns the bounds, conservative to rounding (1e-12 of the elements' size and distance). `pose_a`, `pose_b`: from
/// the frame of each element's link to a common frame. The distance of the cores of spheres, capsules and swept boxes
/// is computed, and their radii are subtracted (Gilbert, Johnson, Keerthi: A fast procedure for computing the distance
/// between complex objects in three-dimensional space, IEEE J. Robotics Automation 4, 1988). The lower bound is the gap
/// along a direction that separates them, so it holds wherever the iteration ends. O(vertices) a step.
Separation separation(const Element& a, const Element& b, const Pose& pose_a = {}, const Pose& pose_b = {});

} // namespace collision
} // namespace foam
