// Balls within half-spaces.
#pragma once

#include "cover/starts/enclosing_ball.hpp"

namespace foam::inline search::cover {

/// A ball satisfies the limit if normal · centre + radius <= offset. For a half-space the normal is a unit vector that
/// points out of it; a shorter normal with a proportional offset leaves room for the ball to grow by a share of its
/// radius.
struct Limit {
    Vec3 normal;
    double offset = 0; ///< units
};
using Limits = std::vector<Limit>;

/// Returns by how much a ball exceeds its most violated limit; 0 if it satisfies all.
double beyond(const Ball& ball, const Limits& limits);

/// The ball that contains some points, satisfies the limits and has the least radius + tilt · centre. Limits enter the
/// cost at prices λ (Lagrange multipliers): radius + tilt · centre + Σ λ (normal · centre + radius). Up to a factor,
/// this is the cost of a ball without limits with the tilt (tilt + Σ λ normal) / (1 + Σ λ). The prices are found one
/// after another until the limits are satisfied. A half-space is the limit of balls of rising radius, so such a ball
/// always exists for one limit if the points satisfy it; between several limits there may be none.
class LimitedBall {
public:
    explicit LimitedBall(Limits limits = {}) : limits_(std::move(limits)), prices_(limits_.size(), 0) {}

    /// Returns the ball of the first `count` points; without points, a ball without radius. `near`: an estimate of the
    /// result. If there is no such ball, it returns one that contains the points.
    Ball of(const Points& points, std::size_t count, const Vec3& tilt, const Vec3& near);

private:
    /// Sets the price of one limit, given the others'.
    Ball kept_to(std::size_t limit, const Points& points, std::size_t count, const Vec3& tilt, const Ball& now);

    Limits limits_;
    std::vector<double> prices_;
    EnclosingBall enclosing_ball_;
};

} // namespace foam::search::cover
