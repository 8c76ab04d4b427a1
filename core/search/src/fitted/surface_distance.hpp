// How far the surface of a solid lies from balls.
#pragma once

#include "by_spheres/measured/points.hpp"
#include "by_spheres/moves/near_balls.hpp"

namespace foam::inline search::fitted {

/// Distances of points of a solid's surface from the union of balls, in the unit frame: 0 inside a ball.
class SurfaceDistance {
public:
    /// `points`: the number of points on the surface, even by area.
    SurfaceDistance(const Solid& solid, const by_spheres::Frame& frame, std::size_t points);

    struct Weights {
        double mean = 0; ///< of the mean distance
        double high = 0; ///< of a power mean of the distances, which has a derivative and is near the largest one
    };

    /// Returns the weighted sum of the mean and the power mean, in the units of weights times length.
    double of(const by_spheres::Balls& balls, const Weights& weights) const;

    /// Adds its derivatives by the balls: each uncovered point pulls the ball nearest to it. `turn`: the set of points.
    void add_slopes(const by_spheres::Balls& balls, std::size_t turn, const Weights& weights,
                    std::vector<by_spheres::Slope>& slopes) const;

    /// Adds the growth of the mean distance without each ball, times its weight; estimated on one set of points.
    void add_uses(const by_spheres::Balls& balls, const Weights& weights, std::vector<double>& uses) const;

    struct Farthest {
        Vec3 place{};
        float distance = 0;
    };
    /// Returns the point that is farthest from the balls.
    Farthest farthest(const by_spheres::Balls& balls) const;

    /// Points of the surface, one in four.
    const by_spheres::Points& some_points() const { return sets_.front(); }

private:
    std::vector<by_spheres::Points> sets_; ///< steps use them in turn
};

} // namespace foam::inline search::fitted
