#include <foam/geometry/internal/overlap.hpp>

namespace foam::inline geometry {

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

} // namespace foam::inline geometry
