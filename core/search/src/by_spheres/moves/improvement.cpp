#include "by_spheres/moves/moves.hpp"

#include "by_spheres/moves/near_balls.hpp"
#include "by_spheres/portfolio/problem.hpp"
#include "by_spheres/starts/power_cells.hpp"
#include "by_spheres/starts/starts.hpp"

#include <foam/base/cancellation.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace foam::inline search::by_spheres {
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

/// Returns, for each ball, whether it contains one of the points that no other ball contains. `owners`: of the points.
std::vector<char> hold_some_alone(const Balls& balls, const Points& points, const Owners& owners) {
    std::vector<char> result(balls.size(), 0);
    NearBalls near;
    near.update(balls);
    CancellationCounter some(64);
    for (std::size_t p = 0; p < points.size(); ++p) {
        some.check();
        const auto contained_in = [&](std::uint32_t i) {
            return balls[i].squared_distance(points.x[p], points.y[p], points.z[p]) <= balls[i].r * balls[i].r;
        };
        // A ball that contains it alone has the least power there.
        const std::uint32_t owner = owners.owner[p];
        if (!result[owner] && contained_in(owner)) {
            result[owner] = std::ranges::none_of(
                near.of(owner), [&](std::uint32_t other) { return other != owner && contained_in(other); });
        }
    }
    return result;
}

/// Returns how far a point lies outside its owner, negative inside.
float gap_to_owner(const Balls& balls, const Owners& owners, std::size_t point) {
    const float r = balls[owners.owner[point]].r;
    return std::sqrt(std::max(0.0f, owners.power[point] + r * r)) - r;
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
    Owners owners;
    owners.find(points, balls);
    std::vector<char> needed = hold_some_alone(balls, points, owners);
    std::vector<float> gaps(points.size());
    for (std::size_t p = 0; p < points.size(); ++p) {
        gaps[p] = gap_to_owner(balls, owners, p);
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
        if (const Balls more = other == order.end() ? balls : split(balls, *other, points, gaps, random);
            more.size() > balls.size()) {
            balls[*other] = more[*other];
            balls[idle] = more.back();
            needed[*other] = 1;
            for (const std::uint32_t p : owners.update(points, balls, *other, idle)) {
                gaps[p] = gap_to_owner(balls, owners, p);
            }
        }
        if (other != order.end()) {
            order.erase(other);
        }
    }
}

double Improvement::waste(const Balls& balls, std::size_t i) const {
    Exposed exposed;
    return exposed.look(balls, i, directions_[0]) ? waste(exposed, balls[i]) : 0;
}

double Improvement::waste(const Exposed& exposed, const Ball& ball) const {
    const Points& directions = directions_[0];
    double outside = 0;
    for (std::size_t k = 0; k < directions.size(); ++k) {
        if (exposed.depth()[k] > 0) {
            outside += problem_.occupancy.outside(ball.x + ball.r * directions.x[k], ball.y + ball.r * directions.y[k],
                                                  ball.z + ball.r * directions.z[k]);
        }
    }
    return outside * ball.r * ball.r * ball.r;
}

std::vector<std::size_t> Improvement::by_waste(const Balls& balls) const {
    NearBalls near;
    near.update(balls);
    Exposed exposed;
    std::vector<double> wastes(balls.size(), 0);
    for (std::size_t i = 0; i < balls.size(); ++i) {
        if (exposed.look(balls, i, directions_[0], near.of(i))) {
            wastes[i] = waste(exposed, balls[i]);
        }
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

} // namespace foam::search::by_spheres
