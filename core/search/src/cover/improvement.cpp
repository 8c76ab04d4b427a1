#include "improvement.hpp"

#include "claim.hpp"
#include "crease_points.hpp"
#include "exposed.hpp"
#include "starts.hpp"
#include "waiting_points.hpp"

#include <foam/base/cancellation.hpp>

#include <algorithm>
#include <numeric>

namespace foam::inline search::cover {
namespace {

/// Edge length of pieces at creases, in step lengths: about as far as creases move between two updates…
constexpr float crease_steps = 4;
/// … but at least this share of the balls' mean radius.
constexpr float finest_crease = 0.02f;

Points prefix(const Points& points, std::size_t count) {
    Points some;
    for (std::size_t i = 0; i < std::min(count, points.size()); ++i) {
        some.add(points, i);
    }
    return some;
}

float mean_radius(const Balls& balls) {
    float sum = 0;
    for (const Ball& ball : balls) {
        sum += ball.r;
    }
    return sum / static_cast<float>(balls.size());
}

} // namespace

std::vector<std::size_t> by_falling(const std::vector<double>& values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return values[a] != values[b] ? values[a] > values[b] : a < b; });
    return order;
}

Improvement::Improvement(const Problem& problem, std::size_t directions, std::size_t first_points)
    : problem_(problem), first_points_(first_points) {
    for (std::uint64_t turn = 0; turn < 4; ++turn) {
        directions_.push_back(spread_directions(directions, turn));
    }
}

Balls Improvement::improved(Balls balls, const DescentPlan& plan, bool creases) const {
    constexpr std::size_t points_per_ball = 25, crease_points_per_ball = 6, fewest_crease_points = 500;
    const std::size_t most_crease_points = std::max(fewest_crease_points, crease_points_per_ball * balls.size());
    constexpr float long_step = 0.02f;
    const float size = mean_radius(balls);
    Points points, base = prefix(problem_.surface, first_points_ + points_per_ball * balls.size());
    WaitingPoints watch(problem_.surface, base.size());
    Descent(problem_.occupancy, directions_).run(points, balls, plan, [&](Points& active, float length) {
        watch.add_outside(balls, base);
        if (length > long_step * size) {
            put_idle_to_use(balls, base);
        }
        active = base;
        if (creases) {
            const float finest = std::max(finest_crease * size, crease_steps * length);
            active.append(crease_points(*problem_.solid, problem_.frame, balls, finest, most_crease_points));
        }
    });
    return balls;
}

void Improvement::put_idle_to_use(Balls& balls, const Points& points) const {
    std::vector<char> needed(balls.size(), 0);
    CancellationCounter some(64);
    for (std::size_t p = 0; p < points.size(); ++p) {
        some.check();
        std::size_t holders = 0, last = 0;
        for (std::size_t i = 0; i < balls.size() && holders < 2; ++i) {
            if (balls[i].squared_distance(points.x[p], points.y[p], points.z[p]) <= balls[i].r * balls[i].r) {
                ++holders;
                last = i;
            }
        }
        needed[last] |= static_cast<char>(holders == 1);
    }
    // Among many balls, moving one hardly changes the excess volume of the others.
    const std::size_t often = 1 + balls.size() / 64;
    std::size_t moved = 0;
    std::vector<std::size_t> order;
    for (std::size_t idle = 0; idle < balls.size(); ++idle) {
        if (needed[idle]) {
            continue;
        }
        if (moved++ % often == 0) {
            order = by_waste(balls);
        }
        const auto other = std::find_if(order.begin(), order.end(), [&](std::size_t i) { return i != idle; });
        Random random(idle);
        if (const Balls more = other == order.end() ? balls : split(balls, *other, points, random);
            more.size() > balls.size()) {
            balls[*other] = more[*other];
            balls[idle] = more.back();
            needed[*other] = 1;
        }
        if (other != order.end()) {
            order.erase(other);
        }
    }
}

double Improvement::waste(const Balls& balls, std::size_t i) const {
    Exposed exposed;
    const Points& directions = directions_[0];
    const Ball& ball = balls[i];
    double outside = 0;
    if (exposed.look(balls, i, directions)) {
        for (std::size_t k = 0; k < directions.size(); ++k) {
            if (exposed.depth()[k] > 0) {
                outside +=
                    problem_.occupancy.outside(ball.x + ball.r * directions.x[k], ball.y + ball.r * directions.y[k],
                                               ball.z + ball.r * directions.z[k]);
            }
        }
    }
    return outside * ball.r * ball.r * ball.r;
}

std::vector<std::size_t> Improvement::by_waste(const Balls& balls) const {
    std::vector<double> wastes;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        wastes.push_back(waste(balls, i));
    }
    return by_falling(wastes);
}

std::vector<Sphere> Improvement::spheres_of(const Balls& balls) const {
    std::vector<Sphere> spheres;
    for (const Ball& b : balls) {
        if (b.r > 0 || (&b == &balls.back() && spheres.empty())) {
            spheres.push_back({problem_.frame.from_unit({b.x, b.y, b.z}), b.r * problem_.frame.unit});
        }
    }
    return spheres;
}

} // namespace foam::search::cover
