// A box seen from another frame.
#pragma once

#include <foam/geometry/vector.hpp>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// Returns the axis-aligned box around the corners of a box at a pose.
inline Box posed(const Box& box, const Pose& pose) {
    Box result;
    for (int corner = 0; corner < 8; ++corner) {
        result.add(pose * Vec3{corner & 1 ? box.low.x : box.high.x, corner & 2 ? box.low.y : box.high.y,
                               corner & 4 ? box.low.z : box.high.z});
    }
    return result;
}

} // namespace geometry
} // namespace foam
