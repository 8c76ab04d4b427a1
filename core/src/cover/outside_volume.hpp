// What one or two balls claim beside others and outside a solid.
#pragma once

#include "cover/occupancy.hpp"

#include <span>

namespace foam::cover {

/// Sums over a lattice of the region in question; the surfaces of balls are blurred over the width of a cell, so that
/// sums change smoothly with the balls and are right to second order in the cell.
class OutsideVolume {
public:
    /// `cells`: of the lattice, across the region. The occupancy must outlive this.
    OutsideVolume(const Occupancy& occupancy, int cells) : occupancy_(occupancy), cells_(cells) {}

    /// Looks at the balls around a region, a little larger than `region`.
    void look(const Balls& others, const Ball& region);
    /// Of the union of one or two balls, less the others and the solid, units³. What lies beyond the region counts in
    /// full and more.
    double of(std::span<const Ball> balls) const;
    /// Of ball `i` of these: the integral of the normal over the surface that shows, over its area. No longer than a
    /// half: it is true of small steps only.
    Vec3 tilt(std::span<const Ball> balls, std::size_t i) const;

private:
    void look_along_row(float x, float y, float z, const Balls& others);

    const Occupancy& occupancy_;
    int cells_;
    Ball region_{}; ///< of the lattice
    float cell_ = 1;
    std::vector<float> row_;
    Points points_; ///< where not all is held by others or the solid
    std::vector<float> weight_;
};

} // namespace foam::cover
