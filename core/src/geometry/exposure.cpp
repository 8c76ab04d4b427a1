#include "geometry/exposure.hpp"

#include "geometry/fibonacci.hpp"

#include <numbers>

namespace foam::geometry {

Exposure::Exposure(const Solid& solid, std::size_t directions)
    : solid_(solid), directions_(fibonacci_directions(directions)) {}

double Exposure::area(std::span<const Sphere> balls, std::size_t i, double radius) const {
    if (!(radius > 0)) {
        return 0;
    }
    const Vec3 center = balls[i].center;
    std::vector<Sphere> near;
    for (std::size_t j = 0; j < balls.size(); ++j) {
        if (j != i && distance(center, balls[j].center) < radius + balls[j].radius) {
            near.push_back(balls[j]);
        }
    }
    std::size_t count = 0;
    for (const Vec3& n : directions_) {
        const Vec3 p = center + radius * n;
        count += exposed(p, near) && !solid_.contains(p);
    }
    return 4 * std::numbers::pi * radius * radius * static_cast<double>(count) /
           static_cast<double>(directions_.size());
}

double Exposure::change(std::span<const Sphere> balls, std::size_t i, double radius) const {
    const double from = balls[i].radius;
    return (radius - from) * (area(balls, i, from) + area(balls, i, radius)) / 2;
}

} // namespace foam::geometry
