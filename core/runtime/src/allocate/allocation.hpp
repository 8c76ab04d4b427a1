// Allocation: the distribution of a number of spheres over the links.
#pragma once

#include <foam/geometry/objective.hpp>
#include <foam/recipe/recipe.hpp>
#include <foam/sdk/registry.hpp>

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace foam::inline runtime {

/// Returns the objective of a call of a spherizer, from its StageInfo::objective_parameter; nothing if it is not one of
/// foam's objectives.
std::optional<Objective> objective_of(const StageCall& spherizer, const Registry& registry);

/// Returns the figure that the objective minimises, of the spheres grown to cover the solid: the excess volume, m³, the
/// largest protrusion, m, or the largest radius, m.
double figure_of(const Solid& solid, const std::vector<Sphere>& spheres, Objective objective);
/// Returns the same for elements of any kind; their size is the radius of the smallest sphere around each.
double figure_of(const Solid& solid, const Elements& elements, Objective objective);

/// Cost of the spheres of a shape. Costs compare by `over` first: no volume makes up for a violated limit.
struct Cost {
    double over = 0;   ///< m; by how much the spheres exceed the limits on protrusion and at half-space constraints
    double volume = 0; ///< m³; excess or missing volume or both, by the guarantee: see cost_volume()

    auto operator<=>(const Cost&) const = default;
    Cost operator+(const Cost& other) const { return {over + other.over, volume + other.volume}; }
};

/// The known costs of a shape by number of spheres.
class CostCurve {
public:
    void set(std::size_t count, Cost cost) { known_[count] = cost; }
    bool knows(std::size_t count) const { return known_.contains(count); }
    const std::map<std::size_t, Cost>& known() const { return known_; }
    /// Returns the least known cost. Precondition: at least one cost is known.
    Cost least() const;
    /// Returns the known count that minimises weight · volume + price · count, the largest of equals. `price`: m³ per
    /// sphere. Precondition: at least one cost is known.
    std::size_t demand(double price, double weight = 1) const;

private:
    std::map<std::size_t, Cost> known_;
};

/// A participant of the allocation: the known costs of one group, or of several that get equal counts.
struct WeightedCurve {
    const CostCurve* curve = nullptr;
    double weight = 1;      ///< factor on the volume of its costs
    std::size_t groups = 1; ///< that take the count and the cost, each
};

/// The optimal allocation for every number of spheres: a dynamic programme over the curves, O(curves · most · known
/// counts). It is exact: a larger `most` or more known counts never raise the sum of costs.
class Allocation {
public:
    /// Precomputes the allocations of up to `most` spheres. A `most` above the largest sum of known counts takes no
    /// longer than that sum.
    Allocation(std::vector<WeightedCurve> weighted_curves, std::size_t most);
    /// Returns one known count per curve, of each of its groups: sum at most `most`, least sum of weighted costs, and of equal sums the fewest
    /// spheres. Empty if no counts fit.
    std::vector<std::size_t> best() const;
    /// Returns the counts with the fewest spheres whose unweighted volume is at most `volume` and which keep the limits
    /// as well as `most` spheres can. Empty if no counts fit.
    std::vector<std::size_t> fewest(double volume) const;
    /// Returns the unweighted sum of the costs of these counts.
    Cost cost(const std::vector<std::size_t>& counts) const;

private:
    std::vector<std::size_t> counts_of(std::size_t sum) const;

    std::vector<WeightedCurve> weighted_curves_;
    std::size_t columns_;
    std::vector<Cost> best_; ///< the least cost of counts that add up to exactly the index
    std::vector<std::uint32_t> choice_;
};

/// Which counts are tried.
enum class Rungs {
    dense, ///< two at once of rung_above()
    sparse ///< one at once of sparse_rung_above(): where each takes long
};

/// Returns the counts to explore next if all up to `explored` are known. The bounds `least` and `most` are candidate
/// counts too. Empty if `explored` has reached `most`. The counts do not depend on the number of elements to allocate.
std::vector<std::size_t> next_rungs(std::size_t explored, std::size_t least, std::size_t most, Rungs kind);

/// Largest count between which and the next candidate count spheres are added one by one. More spheres would take a
/// time that grows with the square of their number.
constexpr std::size_t most_between = 64;

/// Returns the counts that are requested for a shape with the fixed count `most`: 1, 2, 3, 4, 5, 6, 7, 8, 16, 32, 64
/// from `least`, which is the first, up to `most`; then `most` itself if it is larger. Precondition: 1 <= least <=
/// most.
std::vector<std::size_t> counts_alone(std::size_t least, std::size_t most);
/// Returns the count of these that follows another.
std::size_t count_after(std::size_t count);

} // namespace foam::inline runtime
