// What balls claim wrongly of a solid and what they leave out of it.
#pragma once

#include "cover/directions.hpp"
#include "cover/occupancy.hpp"

namespace foam::fitted {

/// vol(U \ S) + vol(S \ U) of balls in the unit frame, and how it changes with them.
class Misfit {
public:
    Misfit(const Solid& solid, const cover::Frame& frame, int resolution, std::size_t directions);

    /// The sum of both volumes, units³: vol(U) + vol(S) − 2 vol(U ∩ S), the first in closed form, the others by cells.
    double of(const cover::Balls& balls) const;

    struct Slope {
        float x = 0, y = 0, z = 0, r = 0;
    };
    /// Derivatives by the balls. By r_i: the area of ball i outside the other balls, as far as it is outside S, less
    /// that inside; by c_i: the same with the normal. `turn`: which set of directions stands for the areas.
    void slopes(const cover::Balls& balls, std::size_t turn, std::vector<Slope>& result) const;

    /// The largest ball inside the solid and outside `balls`, about the middle of a cell; radius 0 if there is none.
    cover::Ball largest_pocket(const cover::Balls& balls) const;

    /// Of the solid, units³.
    double volume() const { return volume_; }
    /// Middles of cells inside the solid.
    const cover::Points& inside() const { return occupancy_.inside(); }

private:
    double shared_with(const cover::Balls& balls) const;

    cover::Occupancy occupancy_;
    cover::Points cells_;               ///< middles of cells that the solid has a share of …
    std::vector<float> volume_of_cell_; ///< … and how much of them, units³
    double volume_ = 0;
    std::vector<cover::Points> directions_;
};

} // namespace foam::fitted
