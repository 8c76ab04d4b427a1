#include <foam/geometry/solid_of_balls.hpp>

#include <foam/base/error.hpp>
#include <foam/geometry/internal/bvh.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace foam::inline geometry {
namespace {

void require_ball(const Sphere& ball, std::size_t index) {
    if (!is_finite(ball.center) || !std::isfinite(ball.radius) || ball.radius < 0) {
        throw Error(ErrorCode::geometry,
                    fmt::format("point {} is ({}, {}, {}) with the radius {}; remedy: finite numbers, and radii that "
                                "are not negative",
                                index, ball.center.x, ball.center.y, ball.center.z, ball.radius));
    }
}

Box box_of(const Sphere& ball) {
    const Vec3 reach{ball.radius, ball.radius, ball.radius};
    Box box;
    box.add(ball.center - reach);
    box.add(ball.center + reach);
    return box;
}

/// Returns the balls that lie in no other one: large ones first, those that are equal once.
std::vector<Sphere> outermost(std::vector<Sphere> balls) {
    std::stable_sort(balls.begin(), balls.end(), [](const Sphere& a, const Sphere& b) { return a.radius > b.radius; });
    std::vector<Box> boxes;
    std::transform(balls.begin(), balls.end(), std::back_inserter(boxes), box_of);
    const Bvh bvh = Bvh::quick(boxes);
    std::vector<Sphere> result;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const Sphere& ball = balls[i];
        bool inside = false;
        const auto around = [&](const BvhNode& node) {
            const Vec3& p = ball.center;
            return !inside && p.x >= node.low.x && p.x <= node.high.x && p.y >= node.low.y && p.y <= node.high.y &&
                   p.z >= node.low.z && p.z <= node.high.z;
        };
        for_each_entered(bvh, around, [&](std::uint32_t place) {
            const std::size_t k = bvh.order()[place];
            inside = inside || (k < i && distance(balls[k].center, ball.center) + ball.radius <= balls[k].radius);
        });
        if (!inside) {
            result.push_back(ball);
        }
    }
    return result;
}

} // namespace

std::shared_ptr<const Solid> solid_of_balls(std::span<const Sphere> balls) {
    if (balls.empty()) {
        throw Error(ErrorCode::geometry, "there is no point to cover; remedy: one or more");
    }
    Box all;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        require_ball(balls[i], i);
        all.add(balls[i].center);
    }
    constexpr double least_share = 1e-6;
    const double size = all.diagonal() > 0 ? all.diagonal() : 1;
    std::vector<Sphere> with_volume(balls.begin(), balls.end());
    for (Sphere& ball : with_volume) {
        ball.radius = ball.radius > 0 ? ball.radius : least_share * size;
    }
    std::vector<Solid::Part> parts;
    for (const Sphere& ball : outermost(std::move(with_volume))) {
        parts.push_back({nullptr, Element::sphere(ball.radius), Pose{.translation = ball.center}});
    }
    return Solid::make(std::move(parts));
}

} // namespace foam::inline geometry
