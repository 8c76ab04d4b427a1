#include "by_spheres/measured/points.hpp"

#include <foam/base/random.hpp>
#include <foam/geometry/vector.hpp>

#include <numbers>

namespace foam::inline search::by_spheres {

Points spread_directions(std::size_t count, std::uint64_t turn) {
    Random random(turn);
    const double z = random.uniform(-1, 1), across = std::sqrt(1 - z * z);
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    const Pose pose = Pose::from_axis_angle({across * std::cos(angle), across * std::sin(angle), z},
                                            random.uniform(0, 2 * std::numbers::pi));
    Points points;
    for (const Vec3& d : geometry::fibonacci_directions(count)) {
        points.add(turn == 0 ? d : pose.rotate(d));
    }
    return points;
}

} // namespace foam::search::by_spheres
