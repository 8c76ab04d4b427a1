// The symmetric difference of balls and a solid.
#pragma once

#include "by_spheres/measured/occupancy.hpp"
#include "by_spheres/measured/points.hpp"
#include "by_spheres/moves/near_balls.hpp"

namespace foam::inline search::fitted {

/// vol(U \ S) + vol(S \ U) of balls in the unit frame, each by its weight, and its derivatives.
class SymmetricDifference {
public:
    struct Weights {
        double excess = 1, missing = 1;
    };
    SymmetricDifference(const Solid& solid, const by_spheres::Frame& frame, int resolution, std::size_t directions,
                        const Weights& weights);

    /// Returns the weighted symmetric difference, units³. vol(U) is in closed form, vol(S) and vol(U ∩ S) by cells.
    double of(const by_spheres::Balls& balls) const;

    /// Computes the derivatives by the balls. By r_i: the area of ball i outside the other balls and outside S, minus
    /// that inside S, each by its weight; by c_i: the same with the normal. `turn`: the set of directions for the
    /// areas.
    void slopes(const by_spheres::Balls& balls, std::size_t turn, std::vector<by_spheres::Slope>& result) const;

    /// Returns the balls, and more in the largest pockets between them, up to `most` in all: each is the largest ball
    /// inside the solid and outside the others, about the centre of a cell. Fewer if no pocket remains.
    by_spheres::Balls filled(by_spheres::Balls balls, std::size_t most) const;

    /// Returns the growth of the weighted symmetric difference without each ball, units³. The part of the solid that
    /// only this ball contains becomes missing; its own excess volume disappears. The part of the ball outside the
    /// others is estimated, to about a hundredth of the ball.
    std::vector<double> uses(const by_spheres::Balls& balls) const;

    /// Volume of the solid, units³.
    double volume() const { return volume_; }
    /// Returns the centres of about `count` of the cells inside the solid, or of all.
    by_spheres::Points some_inside(std::size_t count) const;

private:
    double shared_with(const by_spheres::Balls& balls) const;

    Weights weights_;
    by_spheres::Occupancy occupancy_;
    by_spheres::Points cells_;               ///< centres of cells that lie at least partly inside the solid …
    std::vector<float> volume_of_cell_; ///< … and the volume of the solid in them, units³
    double volume_ = 0;
    std::vector<by_spheres::Points> directions_;
};

} // namespace foam::inline search::fitted
