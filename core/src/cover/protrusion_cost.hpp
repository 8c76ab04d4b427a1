// How far a ball protrudes from a solid.
#pragma once

#include "cover/ball_cost.hpp"
#include "cover/distance_field.hpp"

namespace foam::cover {

/// The largest distance to the solid over a ball's surface; negative for a ball inside. Of a union of balls it is the
/// largest of its balls': what one ball hides of another lies in a ball that protrudes there at least as far.
class ProtrusionCost final : public BallCost {
public:
    /// `directions`: in which a ball's surface is looked at. `evaluations`: of which a search for the best centre is
    /// made. The field must outlive this.
    ProtrusionCost(const DistanceField& field, std::size_t directions, int evaluations);

    double of(const Ball& ball) const override;
    Ball holding(const Points& points, const Ball& enclosing, const Ball& before) const override;

private:
    const DistanceField& field_;
    Points directions_;
    std::vector<Points> ways_; ///< in which the search goes
    int evaluations_;
};

} // namespace foam::cover
