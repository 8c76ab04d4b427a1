#include "cover/improvement.hpp"

#include "cover/claim.hpp"
#include "cover/closing.hpp"
#include "cover/exposed.hpp"
#include "cover/watch.hpp"

#include <algorithm>

namespace foam::cover {
namespace {

/// Pieces at creases have edges of so many steps' lengths, for creases move by about that between two looks…
constexpr float crease_steps = 4;
/// … but of no less than this share of the balls' mean radius.
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

Improvement::Improvement(const Problem& problem, std::size_t directions, std::size_t first_points)
    : problem_(problem), first_points_(first_points), first_(prefix(problem.surface, first_points)) {
    for (std::uint64_t turn = 0; turn < 4; ++turn) {
        directions_.push_back(spread_directions(directions, turn));
        fine_directions_.push_back(spread_directions(3 * directions, turn));
    }
}

Rated Improvement::improved(Balls balls, const DescentPlan& plan, bool creases) const {
    constexpr std::size_t points_per_ball = 50, crease_points_at_most = 500, crease_points_at_last = 4000;
    const float size = mean_radius(balls);
    Points points, base = prefix(problem_.surface, first_points_ + points_per_ball * balls.size());
    Watch watch(problem_.surface, base.size());
    Descent(problem_.occupancy, directions_)
        .run(points, balls, plan, [&](const Balls& now, Points& active, float length) {
            watch.add_outside(now, base);
            active = base;
            if (creases) {
                const float finest = std::max(finest_crease * size, crease_steps * length);
                active.append(crease_points(*problem_.solid, problem_.frame, now, finest, crease_points_at_most));
            }
        });
    if (creases) {
        base.append(crease_points(*problem_.solid, problem_.frame, balls, 0.06 * size, crease_points_at_last));
    }
    tighten(base, balls);
    return {closed_volume(balls), std::move(balls)};
}

void Improvement::refine(Balls& balls, int steps) const {
    constexpr std::size_t crease_points_at_most = 8000;
    const float size = mean_radius(balls);
    const DescentPlan plan{.steps = steps, .first_step = 0.003f, .last_step = 0.0003f, .refresh = 10};
    Points points, base;
    Watch watch(problem_.surface, 0);
    Descent(problem_.occupancy, fine_directions_)
        .run(points, balls, plan, [&](const Balls& now, Points& active, float length) {
            watch.add_outside(now, base);
            active = base;
            const float finest = std::max(finest_crease * size, crease_steps * length);
            active.append(crease_points(*problem_.solid, problem_.frame, now, finest, crease_points_at_most));
        });
    points = problem_.surface;
    points.append(crease_points(*problem_.solid, problem_.frame, balls, 0.002 * size, crease_points_at_most));
    tighten(points, balls);
}

Rated Improvement::tightened(Balls balls) const {
    tighten(first_, balls);
    return {claimed_volume(balls, directions_[0]), std::move(balls)};
}

std::vector<std::size_t> Improvement::by_waste(const Balls& balls) const {
    Exposed exposed;
    const Points& directions = directions_[0];
    std::vector<std::pair<double, std::size_t>> waste;
    for (std::size_t i = 0; i < balls.size(); ++i) {
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
        waste.push_back({-outside * ball.r * ball.r * ball.r, i});
    }
    std::sort(waste.begin(), waste.end());
    std::vector<std::size_t> order;
    for (const auto& [volume, i] : waste) {
        order.push_back(i);
    }
    return order;
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

Balls Improvement::closed_balls(const Balls& balls, double finest) const {
    Balls grown;
    for (const Sphere& s : closed(*problem_.solid, spheres_of(balls), finest * problem_.frame.unit)) {
        grown.push_back(ball_of({problem_.frame.to_unit(s.center), s.radius / problem_.frame.unit}));
    }
    return grown;
}

/// Points tell what is held only where they are: without closing, the balls that slip best between them would win.
double Improvement::closed_volume(const Balls& balls) const {
    constexpr double finest = 1e-3; // units
    return claimed_volume(closed_balls(balls, finest), fine_directions_[0]);
}

} // namespace foam::cover
