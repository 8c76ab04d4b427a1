// Random swaps: single balls move to where they are worth more.
#pragma once

#include "cover/portfolio/cover_candidate.hpp"
#include "cover/moves/exchange.hpp"
#include "cover/measured/fine_surface.hpp"
#include "cover/moves/improvement.hpp"

#include <foam/base/random.hpp>

#include <functional>

namespace foam::inline search::cover {

/// Random swap as in clustering (Fränti: Efficiency of random swap clustering, Journal of Big Data 5, 2018): a ball at
/// random is removed, one of those with most excess volume is split, and all are refined; the result is kept if it is
/// better. Descents only move balls to their neighbourhood; a swap moves one anywhere. Few swaps are better, so a short
/// descent decides which are worth a long one.
class RandomSwaps {
public:
    /// `coarse`: for splits. All must outlive this.
    RandomSwaps(const Problem& problem, const Improvement& improvement, const FineSurface& skin,
                const IndexedSurface& coarse)
        : problem_(problem), improvement_(improvement), skin_(skin), coarse_(coarse) {}

    /// Returns the best balls after `tries` swaps, which cover the skin. If there are fewer balls than `count`, swaps
    /// add balls and remove none until one is kept. Several swaps are tried at once if there are many. It ends early
    /// once stop() returns true. Deterministic, on any number of threads.
    CoverCandidate improved(const Balls& balls, std::size_t count, int tries, std::uint64_t seed,
                            const std::function<bool()>& stop) const;

private:
    /// Returns the balls after a swap; with infinite volume if it is not worth a long descent.
    CoverCandidate swapped(const CoverCandidate& now, std::size_t count, Random random) const;
    /// Splits a ball. Returns false if none can be split.
    bool split_one(Balls& balls, Random& random) const;
    CoverCandidate settled(const Balls& balls, int steps) const;

    const Problem& problem_;
    const Improvement& improvement_;
    const FineSurface& skin_;
    const IndexedSurface& coarse_;
};

} // namespace foam::inline search::cover
