#include "enclosing_ball.hpp"

#include <vector>

namespace foam::medial {
namespace {

std::size_t farthest(std::span<const Vec3> points, const Vec3& center) {
    std::size_t index = 0;
    double largest = -1;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double d = squared_norm(points[i] - center);
        if (d > largest) {
            largest = d;
            index = i;
        }
    }
    return index;
}

} // namespace

Sphere enclosing_ball(std::span<const Vec3> points) {
    if (points.empty()) {
        return {};
    }
    const Vec3 a = points[farthest(points, points[0])];
    const Vec3 b = points[farthest(points, a)];
    std::vector<Vec3> support{a, b};
    Sphere ball{(a + b) * 0.5, distance(a, b) / 2};
    for (int pass = 0; pass < 100; ++pass) {
        const Vec3 pivot = points[farthest(points, ball.center)];
        const double reach = distance(pivot, ball.center);
        if (reach <= ball.radius * (1 + 1e-12)) {
            break;
        }
        support.push_back(pivot);
        const Sphere next = minimum_enclosing_sphere(support);
        if (!(next.radius > ball.radius)) {
            break; // rounding only
        }
        ball = next;
        std::erase_if(support, [&](const Vec3& p) { return distance(p, ball.center) < ball.radius * (1 - 1e-9); });
    }
    ball.radius = std::max(ball.radius, distance(points[farthest(points, ball.center)], ball.center));
    return ball;
}

} // namespace foam::medial
