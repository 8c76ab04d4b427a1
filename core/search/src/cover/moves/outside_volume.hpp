// The volume of one or two balls outside others and outside a solid.
#pragma once

#include "cover/measured/occupancy.hpp"

#include <span>

namespace foam::inline search::cover {

/// Sums over a lattice of a region. The surfaces of balls are blurred over the width of a cell, so that sums vary
/// smoothly with the balls and are right to second order in the cell.
class OutsideVolume {
public:
    /// `cells`: of the lattice, across the region. The occupancy must outlive this.
    OutsideVolume(const Occupancy& occupancy, int cells) : occupancy_(occupancy), cells_(cells) {}

    /// Prepares the balls around a region, slightly larger than `region`.
    void look(const Balls& others, const Ball& region);
    /// Returns the volume of the union of one or two balls, without the others and the solid, units³. Parts beyond the
    /// region count fully and with a surcharge.
    double of(std::span<const Ball> balls) const;
    /// Returns, for ball `i` of these, the integral of the normal over the exposed surface, divided by its area. It is
    /// at most a half long, as it is valid for small steps only.
    Vec3 tilt(std::span<const Ball> balls, std::size_t i) const;

private:
    void look_along_row(float x, float y, float z, const Balls& others);

    const Occupancy& occupancy_;
    int cells_;
    Ball region_{}; ///< region of the lattice
    float cell_ = 1;
    std::vector<float> row_;
    Points points_; ///< places not entirely inside others or the solid
    std::vector<float> weight_;
};

} // namespace foam::search::cover
