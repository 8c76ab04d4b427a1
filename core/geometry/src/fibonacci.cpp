#include <foam/geometry/internal/fibonacci.hpp>

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

bool overlapping(std::span<const Sphere> balls, std::size_t i, std::vector<Sphere>& near) {
    near.clear();
    const Sphere& ball = balls[i];
    for (std::size_t j = 0; j < balls.size(); ++j) {
        const Sphere& other = balls[j];
        const double d = distance(ball.center, other.center);
        if (j == i || d >= ball.radius + other.radius || d + other.radius <= ball.radius) {
            if (j < i && other == ball) {
                return false;
            }
            continue; // apart, or inside this one: cuts nothing from its surface
        }
        if (d + ball.radius <= other.radius) {
            return false;
        }
        near.push_back(other);
    }
    return true;
}

} // namespace foam::geometry
