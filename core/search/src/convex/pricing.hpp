// What pieces of a body cost.
#pragma once

#include "cover/measured/occupancy.hpp"
#include "cut_search.hpp"
#include "pieces.hpp"

#include <functional>
#include <span>
#include <vector>

namespace foam::inline search::convex {

/// Sums of the volumes of hulls, which hardly overlap. No other element around a piece has less volume.
class SumOfHulls : public Pricing {
public:
    void appraise(Piece& piece) const override;
    Beside beside(const std::vector<Piece>& pieces, std::span<const std::size_t> replaced) const override;
};

/// The volume outside the solid of the union of quick fits. What several elements hold counts once.
class VolumeOutside : public Pricing {
public:
    /// Returns the element of a piece from the points that it is to hold.
    using FitAround = std::function<Fit(std::span<const Vec3>)>;
    VolumeOutside(const cover::Occupancy& occupancy, FitAround fit_around)
        : occupancy_(occupancy), fit_around_(std::move(fit_around)) {}

    void appraise(Piece& piece) const override;
    Beside beside(const std::vector<Piece>& pieces, std::span<const std::size_t> replaced) const override;

private:
    const cover::Occupancy& occupancy_;
    FitAround fit_around_;
};

} // namespace foam::inline search::convex
