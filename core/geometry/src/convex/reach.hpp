// Cores that reach farther along their own axes.
#pragma once

#include "convex/kind.hpp"

namespace foam::inline geometry {

/// Makes the core reach from `low` to `high` along an axis as well.
inline void reach_along(Element& e, int axis, double low, double high) {
    const double from = std::min(low, -e.half[axis]), to = std::max(high, e.half[axis]);
    if (from < -e.half[axis] || to > e.half[axis]) {
        Vec3 middle{};
        middle[axis] = (from + to) / 2;
        // Rounded outwards: the ends are off by no more than the rounding of the pose.
        e.half[axis] = (to - from) / 2 * (1 + 4e-16) + 4e-16 * (norm(e.pose.translation) + std::abs(middle[axis]));
        e.pose.translation += e.pose.rotate(middle);
    }
}

/// Returns the box around all within `room` of the points, in the element's frame.
inline Box own_box(const Element& e, std::span<const Vec3> points, double room) {
    Box box;
    for (const Vec3& p : points) {
        box.add(Box::about(to_own_frame(e, p), {room, room, room}));
    }
    return box;
}

} // namespace foam::inline geometry
