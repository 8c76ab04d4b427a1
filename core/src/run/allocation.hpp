// Sharing a number of spheres among the links.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

namespace foam {

/// What is known of a shape's cost (volume that its spheres claim wrongly, m³) by the number of spheres.
class CostCurve {
public:
    void set(std::size_t count, double cost) { known_[count] = cost; }
    bool knows(std::size_t count) const { return known_.contains(count); }
    /// Known, or estimated: linear in log-log between known counts; beyond the last falling as count^-0.4, which is how
    /// excess was seen to fall on robot links. Precondition: something is known.
    double at(std::size_t count) const;
    const std::map<std::size_t, double>& known() const { return known_; }

private:
    std::map<std::size_t, double> known_;
};

/// One taker of spheres.
struct Claim {
    const CostCurve* curve = nullptr;
    std::size_t least = 1, most = 1; ///< bounds of its count
    bool known_only = false;         ///< only counts that the curve knows
};

/// Counts that add up to `total` with the least sum of costs: dynamic programme over the claims, O(claims · total ·
/// most). Empty if no counts within the bounds add up to it.
std::vector<std::size_t> allocate(const std::vector<Claim>& claims, std::size_t total);

/// Counts that add up to at most `total` with the least sum of costs; of sums that are the same to a thousandth, which
/// is what costs are off, the largest. More spheres are not taken where they make it worse. Empty if no counts fit.
std::vector<std::size_t> allocate_at_most(const std::vector<Claim>& claims, std::size_t total);

} // namespace foam
