// What a ball costs that holds its points: its volume, or its protrusion.
#pragma once

#include "by_spheres/measured/occupancy.hpp"
#include "by_spheres/starts/enclosing_ball.hpp"

namespace foam::inline search::by_spheres {

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

/// The largest distance to the solid over a ball's surface; negative for a ball inside. For a union it is the maximum
/// over its balls: the part of one ball that another hides lies in a ball that protrudes there at least as far.
class ProtrusionCost final : public BallCost {
public:
    /// `directions`: at which a ball's surface is evaluated. `evaluations`: number of these in a search for the best
    /// centre. The field must outlive this.
    ProtrusionCost(const DistanceField& field, std::size_t directions, int evaluations);

    double of(const Ball& ball) const override;
    Ball holding(const Points& points, const Ball& enclosing, const Ball& before) const override;

private:
    const DistanceField& field_;
    Points directions_;
    std::vector<Points> ways_; ///< directions of the search
    int evaluations_;
};

} // namespace foam::inline search::by_spheres
