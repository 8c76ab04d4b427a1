// What balls claim wrongly of a solid and what they leave out of it.
#pragma once

#include "cover/directions.hpp"
#include "cover/exposed.hpp"
#include "cover/occupancy.hpp"

namespace foam::fitted {

/// vol(U \ S) + vol(S \ U) of balls in the unit frame, and how it changes with them.
class Misfit {
public:
    Misfit(const Solid& solid, const cover::Frame& frame, int resolution, std::size_t directions);

    /// The sum of both volumes, units³: vol(U) + vol(S) − 2 vol(U ∩ S), the first in closed form, the others by cells.
    double of(const cover::Balls& balls) const;

    /// Derivatives by the balls. By r_i: the area of ball i outside the other balls, as far as it is outside S, less
    /// that inside; by c_i: the same with the normal. `turn`: which set of directions stands for the areas.
    void slopes(const cover::Balls& balls, std::size_t turn, std::vector<cover::Slope>& result) const;

    /// The balls, and more in the largest pockets that they leave, up to `most` in all: each the largest ball inside
    /// the solid and outside the others, about the middle of a cell. Fewer where no pocket is left.
    cover::Balls filled(cover::Balls balls, std::size_t most) const;

    /// What the sum of both volumes grows by without each ball, units³: the part of the solid that it alone holds goes
    /// from right to wrong, what it alone claims outside the other way. That part is estimated, to some hundredth of
    /// the ball.
    std::vector<double> uses(const cover::Balls& balls) const;

    /// Of the solid, units³.
    double volume() const { return volume_; }
    /// Middles of about `count` of the cells inside the solid, or of all.
    cover::Points some_inside(std::size_t count) const;

private:
    double shared_with(const cover::Balls& balls) const;

    cover::Occupancy occupancy_;
    cover::Points cells_;               ///< middles of cells that the solid has a share of …
    std::vector<float> volume_of_cell_; ///< … and how much of them, units³
    double volume_ = 0;
    std::vector<cover::Points> directions_;
};

} // namespace foam::fitted
