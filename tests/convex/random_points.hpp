// Points by chance: in a box of some size, at a pose.
#pragma once

#include <foam/base/random.hpp>
#include <foam/geometry/vector.hpp>

#include <cstdint>
#include <vector>

namespace foam::test {

/// `size`: half the edge lengths of the box.
inline std::vector<Vec3> random_points(Random& random, std::size_t count, const Vec3& size, const Pose& pose = {}) {
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < count; ++i) {
        points.push_back(pose * Vec3{size.x * random.uniform(-1, 1), size.y * random.uniform(-1, 1),
                                     size.z * random.uniform(-1, 1)});
    }
    return points;
}

inline std::vector<Vec3> random_points(std::size_t count, std::uint64_t seed, const Vec3& size = {1, 0.6, 0.3},
                                       const Pose& pose = {}) {
    Random random(seed);
    return random_points(random, count, size, pose);
}

} // namespace foam::test
