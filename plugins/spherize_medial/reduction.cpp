#include "optimise.hpp"

#include <foam/base/cancellation.hpp>

#include <algorithm>
#include <numbers>

namespace foam::medial {

std::vector<std::uint32_t> assign(std::span<const Vec3> points, std::span<const Sphere> balls) {
    std::vector<std::uint32_t> owner(points.size(), 0);
    CancellationCounter asking(256);
    for (std::size_t p = 0; p < points.size(); ++p) {
        asking.check();
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < balls.size(); ++i) {
            const double gap = distance(points[p], balls[i].center) - balls[i].radius;
            if (gap < least) {
                least = gap;
                owner[p] = static_cast<std::uint32_t>(i);
            }
        }
    }
    return owner;
}

std::vector<std::vector<Vec3>> grouped(std::span<const Vec3> points, std::span<const std::uint32_t> owner,
                                       std::size_t count) {
    std::vector<std::vector<Vec3>> groups(count);
    CancellationCounter asking(1024);
    for (std::size_t p = 0; p < points.size(); ++p) {
        asking.check();
        groups[owner[p]].push_back(points[p]);
    }
    return groups;
}

namespace {

/// Gives each empty group the half of the group with the largest ball that lies farthest along its longest direction.
void refill(std::vector<std::vector<Vec3>>& groups, std::vector<Sphere>& balls) {
    for (std::size_t i = 0; i < groups.size(); ++i) {
        check_cancelled();
        if (!groups[i].empty()) {
            continue;
        }
        std::size_t widest = 0;
        for (std::size_t j = 1; j < groups.size(); ++j) {
            widest = balls[j].radius > balls[widest].radius ? j : widest;
        }
        std::vector<Vec3>& from = groups[widest];
        if (from.size() < 2 || !(balls[widest].radius > 0)) {
            return; // all points are separate balls
        }
        const Vec3 center = balls[widest].center;
        const Vec3 far = *std::max_element(from.begin(), from.end(), [&](const Vec3& a, const Vec3& b) {
            return squared_norm(a - center) < squared_norm(b - center);
        });
        const auto half = std::stable_partition(from.begin(), from.end(),
                                                [&](const Vec3& p) { return dot(p - center, far - center) <= 0; });
        groups[i].assign(half, from.end());
        from.erase(half, from.end());
        balls[widest] = minimum_enclosing_sphere(from);
        balls[i] = minimum_enclosing_sphere(groups[i]);
    }
}

} // namespace

std::vector<Sphere> fitted(std::span<const Vec3> points, std::vector<Sphere> balls, const Columns& columns,
                           int rounds) {
    std::vector<Sphere> best;
    double least = std::numeric_limits<double>::infinity();
    for (int round = 0; round < rounds; ++round) {
        check_cancelled();
        auto groups = grouped(points, assign(points, balls), balls.size());
        for (std::size_t i = 0; i < balls.size(); ++i) {
            balls[i] = minimum_enclosing_sphere(groups[i]);
        }
        refill(groups, balls);
        const double cost = columns.outside(balls);
        if (!(cost < least)) {
            break;
        }
        least = cost;
        best = balls;
    }
    return best.empty() ? balls : best;
}

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

namespace {

struct Removal {
    double cost = std::numeric_limits<double>::infinity();
    std::vector<Sphere> balls;
};

/// Returns the balls without `gone`. Its points go to the balls that they lie outside of least; these become the
/// enclosing balls of their points.
Removal without(std::size_t gone, std::span<const Sphere> balls, const std::vector<std::vector<Vec3>>& groups,
                const Columns& columns) {
    Removal result;
    result.balls.assign(balls.begin(), balls.end());
    result.balls.erase(result.balls.begin() + static_cast<std::ptrdiff_t>(gone));
    const auto owner = assign(groups[gone], result.balls);
    const auto moved = grouped(groups[gone], owner, result.balls.size());
    for (std::size_t i = 0; i < moved.size(); ++i) {
        if (!moved[i].empty()) {
            std::vector<Vec3> points = groups[i < gone ? i : i + 1];
            points.insert(points.end(), moved[i].begin(), moved[i].end());
            result.balls[i] = minimum_enclosing_sphere(points);
        }
    }
    result.cost = columns.outside(result.balls);
    return result;
}

} // namespace

std::vector<Sphere> burst(std::span<const Vec3> points, std::vector<Sphere> balls, std::size_t count,
                          const Columns& columns, Context& context) {
    while (balls.size() > count) {
        context.check_cancelled();
        const auto groups = grouped(points, assign(points, balls), balls.size());
        Removal best;
        for (std::size_t i = 0; i < balls.size(); ++i) {
            Removal removal = without(i, balls, groups, columns);
            if (removal.cost < best.cost || best.balls.empty()) {
                best = std::move(removal);
            }
        }
        balls = std::move(best.balls);
    }
    return balls;
}

} // namespace foam::medial
