// The volume of one or two elements outside others and outside a solid.
#pragma once

#include "cover/measured/occupancy.hpp"
#include "cloud.hpp"

#include <span>
#include <vector>

namespace foam::inline search::convex {

/// Sums over a lattice of a region, in the unit frame of a body. The surfaces of elements are blurred over the width of
/// a cell, so that sums vary smoothly with the elements.
class OutsideLattice {
public:
    /// The occupancy must outlive this.
    explicit OutsideLattice(const cover::Occupancy& occupancy) : occupancy_(occupancy) {}

    /// Prepares a lattice of about so many cells over a region, beside the others. O(cells · others).
    void look(std::span<const Fit> others, const Box& region, std::size_t cells);
    /// Returns the volume of the union of the elements without the others and the solid, units³. What is beyond the
    /// region counts in full, and with a surcharge. O(cells · elements).
    double of(std::span<const Fit> elements);
    /// Returns the share of a place that is outside the solid.
    double outside_solid(const Vec3& p) const;

private:
    /// Makes the share that is held at each place at least that of the fit.
    void hold(const Fit& fit);

    const cover::Occupancy& occupancy_;
    Box region_;
    double cell_ = 1;
    int longest_ = 0;                       ///< axis of the region: places ascend along it
    std::vector<float> x_, y_, z_, weight_; ///< places not entirely inside others or the solid
    std::vector<float> held_;
};

/// Returns the box around a fit.
Box bounds(const Fit& fit);

} // namespace foam::inline search::convex
