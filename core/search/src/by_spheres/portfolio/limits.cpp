#include "by_spheres/portfolio/problem.hpp"

#include <foam/base/cancellation.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace foam::inline search::by_spheres {
namespace {

/// Tolerance of limits, units.
constexpr double tolerance = 1e-5;

/// Returns by how much a ball exceeds a limit; negative: the remaining distance.
double over(const Ball& ball, const Limit& limit) {
    return dot(limit.normal, center_of(ball)) + ball.r - limit.offset;
}

double highest(const Points& points, std::size_t count, const Vec3& normal) {
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < count; ++i) {
        most = std::max(most, dot(normal, points.at(i)));
    }
    return most;
}

/// Returns a ball that contains the points and satisfies the limit. It is moved away from the limit more than the ball
/// exceeds it, as its radius grows, by less than it moves.
Ball backed_off(const Ball& ball, const Limit& limit, const Points& points, std::size_t count) {
    constexpr int doublings = 20;
    Ball best = ball;
    double step = over(ball, limit);
    for (int i = 0; i < doublings && over(best, limit) > tolerance; ++i, step *= 2) {
        best = ball_of({center_of(ball) - limit.normal * step, 0});
        best.r = std::sqrt(farthest(points, count, center_of(best)).squared);
    }
    return best;
}

} // namespace

double beyond(const Ball& ball, const Limits& limits) {
    double most = 0;
    for (const Limit& limit : limits) {
        most = std::max(most, over(ball, limit) - tolerance);
    }
    return most;
}

Ball LimitedBall::of(const Points& points, std::size_t count, const Vec3& tilt, const Vec3& near) {
    constexpr int rounds = 16;
    constexpr double gain = 0.9; // if the violation falls less per round, such a ball hardly exists
    Ball best = enclosing_ball_.of(points, count, tilt, near);
    if (count == 0) {
        return best;
    }
    std::fill(prices_.begin(), prices_.end(), 0);
    Ball ball = best;
    for (int round = 0; round < rounds && beyond(best, limits_) > 0; ++round) {
        check_cancelled();
        const double before = beyond(ball, limits_);
        for (std::size_t i = 0; i < limits_.size(); ++i) {
            if (prices_[i] > 0 || over(ball, limits_[i]) > tolerance) {
                ball = kept_to(i, points, count, tilt, ball);
            }
        }
        const double now = beyond(ball, limits_);
        if (now < beyond(best, limits_)) {
            best = ball;
        }
        if (now > gain * before) {
            break;
        }
    }
    return best;
}

Ball LimitedBall::kept_to(std::size_t limit, const Points& points, std::size_t count, const Vec3& tilt,
                          const Ball& now) {
    constexpr int evaluations = 10;
    constexpr double least_q = 1e-3; // the ball is then some thousand times as large as its content
    const Vec3 normal = limits_[limit].normal;
    double rest = 1;
    Vec3 pull = tilt;
    for (std::size_t k = 0; k < limits_.size(); ++k) {
        if (k != limit) {
            rest += prices_[k];
            pull += limits_[k].normal * prices_[k];
        }
    }
    pull = pull / rest;
    // With the share t = (1 - q²) / (1 + q²) of the price in the cost, a ball about a disc of radius a across the
    // normal reaches a q beyond the disc, so a secant in q converges at once.
    const auto share = [](double q) { return (1 - q * q) / (1 + q * q); };
    Ball ball = now;
    const auto excess = [&](double q) {
        const double t = share(q);
        ball = enclosing_ball_.of(points, count, pull * (1 - t) + normal * t, center_of(ball));
        prices_[limit] = rest * t / (1 - t);
        return over(ball, limits_[limit]) + tolerance / 2;
    };
    double low = 0, below = highest(points, count, normal) - limits_[limit].offset + tolerance / 2;
    double high = 1, above = prices_[limit] == 0 ? over(now, limits_[limit]) + tolerance / 2 : excess(1);
    if (above <= 0 || below >= 0) {
        return ball; // the price is 0, or no ball satisfies the limit
    }
    // Regula falsi that halves the weight of an end that stays (the Illinois rule).
    int last = 0;
    for (int i = 0; i < evaluations; ++i) {
        check_cancelled();
        const double q = std::max(low + (high - low) * below / (below - above), least_q);
        const double value = excess(q);
        if (std::abs(value) <= tolerance / 2 || q == least_q) {
            break;
        }
        if (value > 0) {
            high = q;
            above = value;
            below = last == 1 ? below / 2 : below;
            last = 1;
        } else {
            low = q;
            below = value;
            above = last == -1 ? above / 2 : above;
            last = -1;
        }
    }
    return over(ball, limits_[limit]) > tolerance ? backed_off(ball, limits_[limit], points, count) : ball;
}

} // namespace foam::search::by_spheres
