// Costs of single balls, for searches that minimise the largest cost.
#pragma once

#include "cover/starts/enclosing_ball.hpp"

namespace foam::inline search::cover {

/// The cost of a single ball. Lengths are in the unit frame. Growing a ball by some length raises its cost by at most
/// that length.
class BallCost {
public:
    virtual ~BallCost() = default;
    virtual double of(const Ball& ball) const = 0;
    /// Returns the cheapest ball found that contains all of the points, at least one. `enclosing`: the smallest such
    /// ball; `before`: a ball that contained them. The result costs at most as much as a ball about either of these two
    /// centres.
    virtual Ball holding(const Points& points, const Ball& enclosing, const Ball& before) const = 0;
};

/// The radius as cost: equal balls at best, whose centres solve the k-centre problem of the surface.
class RadiusCost final : public BallCost {
public:
    double of(const Ball& ball) const override { return ball.r; }
    Ball holding(const Points&, const Ball& enclosing, const Ball&) const override { return enclosing; }
};

} // namespace foam::search::cover
