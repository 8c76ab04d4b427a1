// Sharing a number of spheres among the links.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace foam {

/// What the spheres of a shape cost. Less is better, `over` first: no volume makes up for a limit that is not kept.
struct Cost {
    double over = 0;   ///< m; by how much they protrude more, and reach farther beyond planes, than the shape may
    double volume = 0; ///< m³; what they claim wrongly

    auto operator<=>(const Cost&) const = default;
    Cost operator+(const Cost& other) const { return {over + other.over, volume + other.volume}; }
};

/// What is known of a shape's cost by the number of spheres.
class CostCurve {
public:
    void set(std::size_t count, Cost cost) { known_[count] = cost; }
    bool knows(std::size_t count) const { return known_.contains(count); }
    const std::map<std::size_t, Cost>& known() const { return known_; }
    /// The least cost that is known. Precondition: something is known.
    Cost least() const;
    /// The count to take where a sphere costs `price`, m³, and wrong volume counts `weight` times: that with the least
    /// sum of both, of equal sums the largest. Precondition: something is known.
    std::size_t demand(double price, double weight = 1) const;

private:
    std::map<std::size_t, Cost> known_;
};

/// One of those that spheres are shared among.
struct Claimant {
    const CostCurve* curve = nullptr;
    double weight = 1; ///< of its wrong volume
};

/// The best sharing of every number of spheres: dynamic programme over the curves, O(curves · most · known counts).
/// Exact: with more to share or more known the sum of costs is never higher.
class Sharing {
public:
    /// For up to `most` spheres; more than all curves know together need not be asked for.
    Sharing(std::vector<Claimant> claimants, std::size_t most);
    /// Counts that their curves know, one for each, that add up to at most `most` with the least sum of weighted costs,
    /// and of equal sums with the fewest spheres. Empty if no counts fit.
    std::vector<std::size_t> best() const;
    /// The same with the fewest spheres for which the wrong volume, not weighted, is at most `volume` and the limits
    /// are kept as well as `most` spheres can. Empty if no counts fit.
    std::vector<std::size_t> fewest(double volume) const;
    /// Sum of the costs of these counts, not weighted.
    Cost cost(const std::vector<std::size_t>& counts) const;

private:
    std::vector<std::size_t> counts_of(std::size_t sum) const;

    std::vector<Claimant> claimants_;
    std::size_t columns_;
    std::vector<Cost> best_; ///< the least cost of counts that add up to exactly the index
    std::vector<std::uint32_t> choice_;
};

/// Counts to explore next where all up to `explored` are: two rungs of a ladder with steps of one up to eight and four
/// to an octave after that, four rungs at first; within the bounds, of which both belong to the ladder. Empty at the
/// end. No rung depends on how many spheres there are to share.
std::vector<std::size_t> next_rungs(std::size_t explored, std::size_t least, std::size_t most);

/// The counts that a shape is asked for which has `most` spheres of its own: 1, 2, 3, 4, 5, 6, 7, 8, 16, 32… as far as
/// they are above `least`, which is the first, and not above `most`. Precondition: 1 <= least <= most.
std::vector<std::size_t> counts_alone(std::size_t least, std::size_t most);

} // namespace foam
