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

/// Returns the balls that lie in no other one: large ones first, those that are equal once.
std::vector<Sphere> outermost(std::vector<Sphere> balls) {
    std::stable_sort(balls.begin(), balls.end(), [](const Sphere& a, const Sphere& b) { return a.radius > b.radius; });
    std::vector<Box> boxes;
    for (const Sphere& ball : balls) {
        boxes.push_back(Box::about(ball.center, {ball.radius, ball.radius, ball.radius}));
    }
    const Bvh bvh = Bvh::quick(boxes);
    std::vector<Sphere> result;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const Sphere& ball = balls[i];
        bool inside = false;
        const auto around = [&](const BvhNode& node) { return !inside && contains(node, ball.center); };
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

void require_balls(std::span<const Sphere> balls) {
    if (balls.empty()) {
        throw Error(ErrorCode::geometry, "there is no point to cover; remedy: one or more");
    }
    for (std::size_t i = 0; i < balls.size(); ++i) {
        require_ball(balls[i], i);
    }
}

std::shared_ptr<const Solid> solid_of_balls(std::span<const Sphere> balls) {
    require_balls(balls);
    Box all;
    for (const Sphere& ball : balls) {
        all.add(ball.center);
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

std::optional<std::vector<Sphere>> balls_of(const Solid& solid, std::size_t most) {
    if (solid.parts().size() > most) {
        return {};
    }
    std::vector<Sphere> balls;
    for (const Solid::Part& part : solid.parts()) {
        if (!part.primitive || part.primitive->kind != Element::Kind::sphere) {
            return {};
        }
        balls.push_back({part.pose.translation, part.primitive->radius});
    }
    return balls;
}

} // namespace foam::inline geometry
