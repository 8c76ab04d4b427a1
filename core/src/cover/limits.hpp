// Balls that keep to half-spaces.
#pragma once

#include "cover/enclosing_ball.hpp"

namespace foam::cover {

/// A ball keeps to it if normal · centre + radius <= offset. Of a half-space the normal is a unit vector that points
/// out of it; a shorter one and an offset in proportion leave room for the ball to grow by a share of its radius.
struct Limit {
    Vec3 normal;
    double offset = 0; ///< units
};
using Limits = std::vector<Limit>;

/// By how much a ball reaches beyond the limit that it keeps to least; 0 if it keeps to all.
double beyond(const Ball& ball, const Limits& limits);

/// The ball that holds some points, keeps to the limits and has the least radius + tilt · centre. Limits are part of
/// the cost at prices λ (Lagrange multipliers): radius + tilt · centre + Σ λ (normal · centre + radius), which is
/// that of a ball without limits and the tilt (tilt + Σ λ normal) / (1 + Σ λ), but for a factor. The prices are found
/// one after another until the limits are kept. A half-space is a ball's limit for rising radius, so below one limit
/// there always is such a ball if the points are below it; between several there may be none.
class LimitedBall {
public:
    explicit LimitedBall(Limits limits = {}) : limits_(std::move(limits)), prices_(limits_.size(), 0) {}

    /// Of the first `count` points; of none: a ball without radius. `near`: about where it is. If there is no such
    /// ball, one that holds the points all the same.
    Ball of(const Points& points, std::size_t count, const Vec3& tilt, const Vec3& near);

private:
    /// Sets the price of one limit, given the others'.
    Ball kept_to(std::size_t limit, const Points& points, std::size_t count, const Vec3& tilt, const Ball& now);

    Limits limits_;
    std::vector<double> prices_;
    EnclosingBall enclosing_ball_;
};

} // namespace foam::cover
