// What a single ball of a cover costs, where the dearest one is what counts.
#pragma once

#include "cover/enclosing_ball.hpp"

namespace foam::cover {

/// Lengths in the unit frame. A ball costs no more than it would if it were smaller by some length, plus that length.
class BallCost {
public:
    virtual ~BallCost() = default;
    virtual double of(const Ball& ball) const = 0;
    /// Of balls that hold all of the points, at least one, the cheapest that is found. `enclosing`: the smallest one;
    /// `before`: a ball that held them. It costs no more than either of these two centres would.
    virtual Ball holding(const Points& points, const Ball& enclosing, const Ball& before) const = 0;
};

/// The radius: equal balls at best, the centres of which solve the k-centre problem of the surface.
class RadiusCost final : public BallCost {
public:
    double of(const Ball& ball) const override { return ball.r; }
    Ball holding(const Points&, const Ball& enclosing, const Ball&) const override { return enclosing; }
};

} // namespace foam::cover
