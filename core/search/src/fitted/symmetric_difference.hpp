// The symmetric difference of balls and a solid.
#pragma once

#include "cover/measured/occupancy.hpp"
#include "cover/measured/points.hpp"
#include "cover/moves/near_balls.hpp"

namespace foam::inline search::fitted {

/// vol(U \ S) + vol(S \ U) of balls in the unit frame, and its derivatives.
class SymmetricDifference {
public:
    SymmetricDifference(const Solid& solid, const cover::Frame& frame, int resolution, std::size_t directions);

    /// Returns the symmetric difference, units³: vol(U) + vol(S) − 2 vol(U ∩ S), the first in closed form, the others
    /// by cells.
    double of(const cover::Balls& balls) const;

    /// Computes the derivatives by the balls. By r_i: the area of ball i outside the other balls and outside S, minus
    /// that inside S; by c_i: the same with the normal. `turn`: the set of directions for the areas.
    void slopes(const cover::Balls& balls, std::size_t turn, std::vector<cover::Slope>& result) const;

    /// Returns the balls, and more in the largest pockets between them, up to `most` in all: each is the largest ball
    /// inside the solid and outside the others, about the centre of a cell. Fewer if no pocket remains.
    cover::Balls filled(cover::Balls balls, std::size_t most) const;

    /// Returns the growth of the symmetric difference without each ball, units³. The part of the solid that only this
    /// ball contains becomes missing; its own excess volume disappears. The part of the ball outside the others is
    /// estimated, to about a hundredth of the ball.
    std::vector<double> uses(const cover::Balls& balls) const;

    /// Volume of the solid, units³.
    double volume() const { return volume_; }
    /// Returns the centres of about `count` of the cells inside the solid, or of all.
    cover::Points some_inside(std::size_t count) const;

private:
    double shared_with(const cover::Balls& balls) const;

    cover::Occupancy occupancy_;
    cover::Points cells_;               ///< centres of cells that lie at least partly inside the solid …
    std::vector<float> volume_of_cell_; ///< … and the volume of the solid in them, units³
    double volume_ = 0;
    std::vector<cover::Points> directions_;
};

} // namespace foam::inline search::fitted
