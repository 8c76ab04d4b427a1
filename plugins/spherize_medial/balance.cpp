#include "optimise.hpp"
#include "reduction.hpp"

#include <numbers>

namespace foam::medial {

std::vector<Sphere> balance(std::span<const Vec3> points, std::vector<Sphere> balls, double excess,
                            const Columns& columns, Context& context) {
    double volume = columns.volume();
    if (!(volume > 0)) { // a solid without volume: relative to its balls
        for (const Sphere& ball : balls) {
            volume += 4.0 / 3.0 * std::numbers::pi * ball.radius * ball.radius * ball.radius;
        }
    }
    double cost = columns.outside(balls);
    while (balls.size() > 1) {
        std::vector<Sphere> fewer = burst(points, balls, balls.size() - 1, columns, context);
        fewer = fitted(points, std::move(fewer), columns, 4);
        const double next = columns.outside(fewer);
        if (next > cost + excess * volume) {
            break;
        }
        cost = std::min(cost, next);
        balls = std::move(fewer);
    }
    return balls;
}

} // namespace foam::medial
