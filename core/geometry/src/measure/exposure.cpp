#include "measure/exposure.hpp"

#include <foam/geometry/internal/measure_parts.hpp>
#include <foam/geometry/vector.hpp>

#include <numbers>

namespace foam::inline geometry {
namespace {

/// Share below which a change of a radius does not change its area.
constexpr double noticeable = 0.01;

} // namespace

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

GrowthCost::GrowthCost(const Solid& solid, std::size_t count) : exposure_(solid, 48), before_(count), after_(count) {}

double GrowthCost::area(std::span<const Sphere> balls, std::size_t i, double radius, Known& known) const {
    if (!(std::abs(radius - known.radius) <= noticeable * radius)) {
        known = {radius, exposure_.area(balls, i, radius)};
    }
    return known.area;
}

double GrowthCost::of(std::span<const Sphere> balls, std::size_t i, double radius) {
    const double from = balls[i].radius;
    if (after_[i].radius == from) {
        before_[i] = after_[i]; // the ball has grown to the last radius tried
    }
    const double area_before = area(balls, i, from, before_[i]);
    const bool little = radius - from <= noticeable * from;
    return (radius - from) * (little ? area_before : (area_before + area(balls, i, radius, after_[i])) / 2);
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

} // namespace foam::inline geometry
