#include <foam/geometry/directions.hpp>

#include <cmath>
#include <numbers>

namespace foam::inline geometry {

std::vector<Vec3> fibonacci_directions(std::size_t count) {
    const double turn = std::numbers::pi * (3 - std::sqrt(5.0)); // the golden angle
    std::vector<Vec3> directions;
    directions.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(count);
        const double across = std::sqrt(std::max(0.0, 1 - z * z));
        const double angle = turn * static_cast<double>(i);
        directions.push_back({across * std::cos(angle), across * std::sin(angle), z});
    }
    return directions;
}

} // namespace foam::inline geometry
