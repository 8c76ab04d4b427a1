// Sharing a number of spheres among the links.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

namespace foam {

/// What is known of a shape's cost (volume that its spheres claim wrongly, m³) by the number of spheres.
class CostCurve {
public:
    void set(std::size_t count, double cost) { known_[count] = cost; }
    bool knows(std::size_t count) const { return known_.contains(count); }
    const std::map<std::size_t, double>& known() const { return known_; }
    /// The least cost that is known. Precondition: something is known.
    double least() const;
    /// The count to take where a sphere costs `price`: that with the least sum of both, of equal sums the largest.
    /// Precondition: something is known.
    std::size_t demand(double price) const;

private:
    std::map<std::size_t, double> known_;
};

/// Counts that their curves know, one for each, that add up to at most `total` with the least sum of costs, and of
/// equal sums with the fewest spheres: dynamic programme over the curves, O(curves · total · known counts). Exact: with
/// more to share or more known the sum of costs is never higher. Empty if no counts fit.
std::vector<std::size_t> allocate_at_most(const std::vector<const CostCurve*>& curves, std::size_t total);

/// Counts to explore next where all up to `explored` are: two rungs of a ladder with steps of one up to eight and four
/// to an octave after that, four rungs at first; within the bounds, of which both belong to the ladder. Empty at the
/// end. No rung depends on how many spheres there are to share.
std::vector<std::size_t> next_rungs(std::size_t explored, std::size_t least, std::size_t most);

} // namespace foam
