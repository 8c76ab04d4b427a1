// The protrusion of a ball from a solid as cost.
#pragma once

#include "cover/descent/ball_cost.hpp"
#include "cover/measured/distance_field.hpp"

namespace foam::inline search::cover {

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

} // namespace foam::search::cover
