#include "pieces.hpp"

#include "cells.hpp"

#include <algorithm>
#include <limits>
#include <memory>

namespace foam::inline search::convex {

void SumOfHulls::appraise(Piece& piece) const {
    piece.price = volume_of_hull(piece.hull);
}

Beside SumOfHulls::beside(const std::vector<Piece>& pieces, std::span<const std::size_t> replaced) const {
    Beside result;
    for (const std::size_t i : replaced) {
        result.now += pieces[i].price;
    }
    result.price = volume_of_hulls;
    return result;
}

void VolumeOutside::appraise(Piece& piece) const {
    piece.fit = fit_around_(piece.hull);
    piece.price = volume(piece.fit);
}

Beside VolumeOutside::beside(const std::vector<Piece>& pieces, std::span<const std::size_t> replaced) const {
    constexpr std::size_t cells = 1000;
    constexpr double margin = 0.1; // of the diagonal: elements of parts may reach beyond those of the whole
    std::vector<Fit> others, these;
    Box region;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (std::find(replaced.begin(), replaced.end(), i) == replaced.end()) {
            others.push_back(pieces[i].fit);
        } else {
            these.push_back(pieces[i].fit);
            region.add(bounds(pieces[i].fit));
        }
    }
    const Vec3 beyond = Vec3{1, 1, 1} * (margin * region.diagonal());
    Box wide;
    wide.add(region.low - beyond);
    wide.add(region.high + beyond);
    auto lattice = std::make_shared<OutsideLattice>(occupancy_);
    lattice->look(others, wide, cells);
    // Elements thinner than a cell are blurred: they cost no more than their own volumes.
    const auto cost = [lattice, this](std::span<const Fit> fits) {
        double sum = has_volume_ ? 0 : std::numeric_limits<double>::infinity();
        for (const Fit& fit : fits) {
            sum += volume(fit);
        }
        return std::min(sum, lattice->of(fits));
    };
    Beside result;
    result.now = cost(these);
    result.price = [cost, this](std::span<const Vec3> below, std::span<const Vec3> above, double limit) {
        if (below.size() < above.size()) { // the larger part alone may cost too much
            std::swap(below, above);
        }
        std::array<Fit, 2> fits{fit_around_(below)};
        const double one = cost(std::span(fits).first(1));
        if (above.empty() || one >= limit) {
            return one;
        }
        fits[1] = fit_around_(above);
        return cost(fits);
    };
    return result;
}

} // namespace foam::inline search::convex
