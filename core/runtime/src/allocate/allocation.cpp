#include "allocate/allocation.hpp"

#include <foam/base/internal/ladder.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/runtime/internal/cover.hpp>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

namespace foam::inline runtime {

namespace {

constexpr Cost impossible{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};

Cost weighted(const Cost& cost, double weight) {
    return {cost.over, weight * cost.volume};
}

/// Returns the cost of so many groups.
Cost times(std::size_t groups, const Cost& cost) {
    const auto factor = static_cast<double>(groups);
    return {factor * cost.over, factor * cost.volume};
}

} // namespace

Cost CostCurve::least() const {
    Cost least = impossible;
    for (const auto& [count, cost] : known_) {
        least = std::min(least, cost);
    }
    return least;
}

std::size_t CostCurve::demand(double price, double weight) const {
    std::size_t best = 0;
    Cost least = impossible;
    for (const auto& [count, cost] : known_) {
        if (const Cost sum = weighted(cost, weight) + Cost{0, price * static_cast<double>(count)}; sum <= least) {
            least = sum;
            best = count;
        }
    }
    return best;
}

/// Returns an upper bound on every sum of known counts.
static std::size_t largest_sum(const std::vector<WeightedCurve>& weighted_curves) {
    std::size_t sum = 0;
    for (const WeightedCurve& claimant : weighted_curves) {
        sum += claimant.curve->known().empty() ? 0 : claimant.groups * claimant.curve->known().rbegin()->first;
    }
    return sum;
}

Allocation::Allocation(std::vector<WeightedCurve> weighted_curves, std::size_t most)
    : weighted_curves_(std::move(weighted_curves)), columns_(std::min(most, largest_sum(weighted_curves_)) + 1),
      best_(columns_, impossible), choice_(weighted_curves_.size() * columns_, 0) {
    best_[0] = {};
    std::vector<Cost> next(columns_);
    for (std::size_t i = 0; i < weighted_curves_.size(); ++i) {
        std::fill(next.begin(), next.end(), impossible);
        const std::size_t groups = weighted_curves_[i].groups;
        for (const auto& [count, known] : weighted_curves_[i].curve->known()) {
            const Cost cost = times(groups, weighted(known, weighted_curves_[i].weight));
            for (std::size_t sum = groups * count; sum < columns_; ++sum) {
                if (const Cost with = best_[sum - groups * count] + cost; with < next[sum]) {
                    next[sum] = with;
                    choice_[i * columns_ + sum] = static_cast<std::uint32_t>(count);
                }
            }
        }
        std::swap(best_, next);
    }
}

std::vector<std::size_t> Allocation::counts_of(std::size_t sum) const {
    std::vector<std::size_t> counts(weighted_curves_.size());
    for (std::size_t i = weighted_curves_.size(); i-- > 0;) {
        counts[i] = choice_[i * columns_ + sum];
        sum -= weighted_curves_[i].groups * counts[i];
    }
    return counts;
}

std::vector<std::size_t> Allocation::best() const {
    const auto least = std::min_element(best_.begin(), best_.end());
    return *least == impossible ? std::vector<std::size_t>{}
                                : counts_of(static_cast<std::size_t>(least - best_.begin()));
}

std::vector<std::size_t> Allocation::fewest(double volume) const {
    const double over = std::min_element(best_.begin(), best_.end())->over;
    for (std::size_t sum = 0; sum < columns_; ++sum) {
        if (best_[sum] == impossible || best_[sum].over > over) {
            continue;
        }
        if (std::vector<std::size_t> counts = counts_of(sum); cost(counts).volume <= volume) {
            return counts;
        }
    }
    return {};
}

Cost Allocation::cost(const std::vector<std::size_t>& counts) const {
    Cost sum;
    for (std::size_t i = 0; i < weighted_curves_.size(); ++i) {
        sum = sum + times(weighted_curves_[i].groups, weighted_curves_[i].curve->known().at(counts[i]));
    }
    return sum;
}

std::vector<std::size_t> next_rungs(std::size_t explored, std::size_t least, std::size_t most, Rungs kind) {
    const bool dense = kind == Rungs::dense;
    const std::size_t at_once = dense ? 2 : 1;
    std::vector<std::size_t> rungs;
    std::size_t count = explored;
    while (count < most && rungs.size() < at_once) {
        count = std::clamp(dense ? rung_above(count) : sparse_rung_above(count), least, most);
        rungs.push_back(count);
    }
    return rungs;
}

std::size_t count_after(std::size_t count) {
    constexpr std::size_t each = 8; // up to here every count
    return count < each ? count + 1 : 2 * std::bit_floor(count);
}

std::vector<std::size_t> counts_alone(std::size_t least, std::size_t most) {
    std::vector<std::size_t> counts;
    for (std::size_t count = least; count <= std::min(most, most_between); count = count_after(count)) {
        counts.push_back(count);
    }
    if (counts.empty() || most > most_between) {
        counts.push_back(most);
    }
    return counts;
}

std::optional<Objective> objective_of(const StageCall& spherizer, const Registry& registry) {
    const RegisteredStage* stage = registry.find(spherizer.stage);
    if (!stage || stage->info.objective_parameter.empty()) {
        return Objective::excess;
    }
    const auto objective =
        objective_named(Parameters(stage->info.parameters, spherizer.given).text(stage->info.objective_parameter));
    return objective == Objective::mean_protrusion ? std::nullopt : objective; // no figure here compares that
}

double figure_of(const Solid& solid, const std::vector<Sphere>& spheres, Objective objective) {
    switch (objective) {
    case Objective::excess:
        return cost_volume(solid, spheres, Guarantee::outer);
    case Objective::protrusion:
        return covered_protrusion(solid, spheres, Guarantee::outer);
    case Objective::radius:
    case Objective::mean_protrusion: // objective_of() gives none
        break;
    }
    double largest = 0;
    for (const Sphere& sphere : grown_to_cover(solid, spheres)) {
        largest = std::max(largest, sphere.radius);
    }
    return largest;
}

double figure_of(const Solid& solid, const Elements& elements, Objective objective) {
    if (elements.are_spheres()) {
        return figure_of(solid, elements.spheres(), objective);
    }
    switch (objective) {
    case Objective::excess:
        return cost_of_elements(solid, elements, Guarantee::outer);
    case Objective::protrusion:
        return protrusion_of_elements(solid, elements, Guarantee::outer);
    case Objective::radius:
    case Objective::mean_protrusion: // objective_of() gives none
        break;
    }
    const Elements grown = grown_to_cover(solid, elements);
    double largest = 0;
    for (const Sphere& sphere : grown.spheres()) {
        largest = std::max(largest, sphere.radius);
    }
    for (const Element& element : grown.shaped()) {
        largest = std::max(largest, minimum_enclosing_sphere(enclosing_mesh(element).vertices).radius);
    }
    return largest;
}

} // namespace foam::inline runtime
