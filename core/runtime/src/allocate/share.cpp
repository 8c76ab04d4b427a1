#include "allocate/exploration.hpp"

#include <algorithm>
#include <map>
#include <tuple>

namespace foam::inline runtime {

CostCurve within(const CostCurve& curve, const Bounds& bounds) {
    CostCurve result;
    for (const auto& [count, cost] : curve.known()) {
        if (count >= bounds.least && count <= bounds.most) {
            result.set(count, cost);
        }
    }
    return result;
}

namespace {

/// Groups that get equal counts.
struct Claim {
    CostCurve curve;
    double weight = 1;
    std::vector<std::size_t> of; ///< indices into allocated_groups()
};

/// Returns one claim for all groups with equal shape, weight and bounds: links that are alike get models that are
/// alike.
std::vector<Claim> claims_of(const std::vector<ShapeWork>& shapes, const std::vector<Group>& groups,
                             const std::vector<Bounds>& bounds) {
    std::vector<Claim> claims;
    std::map<std::tuple<std::size_t, double, std::size_t, std::size_t>, std::size_t> known;
    const std::vector<std::size_t> allocated = allocated_groups(shapes, groups);
    for (std::size_t i = 0; i < allocated.size(); ++i) {
        const Group& group = groups[allocated[i]];
        const Bounds own = bounds.empty() ? Bounds{} : bounds[i];
        const auto [it, fresh] = known.try_emplace({group.shape, group.weight, own.least, own.most}, claims.size());
        if (fresh) {
            claims.push_back({within(shapes[group.shape].known.curve, own), group.weight, {}});
        }
        claims[it->second].of.push_back(i);
    }
    return claims;
}

} // namespace

Shared share(const std::vector<ShapeWork>& shapes, const std::vector<Group>& groups, const Goal& goal,
             const std::vector<Bounds>& bounds) {
    const std::vector<Claim> claims = claims_of(shapes, groups, bounds);
    std::vector<WeightedCurve> curves;
    for (const Claim& claim : claims) {
        curves.push_back({&claim.curve, claim.weight, claim.of.size()});
    }
    const Allocation allocation(curves, goal.most);
    Shared shared;
    std::vector<std::size_t> of_claims = goal.enough ? allocation.fewest(*goal.enough) : std::vector<std::size_t>{};
    shared.enough = !of_claims.empty();
    if (of_claims.empty()) {
        of_claims = allocation.best();
    }
    for (std::size_t c = 0; c < of_claims.size(); ++c) {
        for (const std::size_t i : claims[c].of) {
            shared.counts.resize(std::max(shared.counts.size(), i + 1));
            shared.counts[i] = of_claims[c];
        }
    }
    return shared;
}

} // namespace foam::inline runtime
