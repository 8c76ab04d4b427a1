#include "best_with_at_most.hpp"

#include <foam/measure.hpp>
#include <foam/parallel.hpp>

#include <map>

namespace foam::medial {
namespace {

std::vector<std::size_t> counts_up_to(std::size_t most) {
    std::vector<std::size_t> counts;
    for (std::size_t count = 1; count < most;
         count = count < 12 ? count + 1 : (count % 3 == 0 ? count / 3 * 4 : count / 2 * 3)) {
        counts.push_back(count);
    }
    counts.push_back(most);
    return counts;
}

} // namespace

std::vector<SphereTree> best_with_at_most(const Solid& solid, std::span<const Budget> budgets, const Maker& make) {
    std::vector<Budget> all;
    std::map<std::size_t, std::size_t> index; // of a count in `all`
    for (const Budget& budget : budgets) {
        if (!budget.max_spheres) {
            continue;
        }
        for (const std::size_t count : counts_up_to(*budget.max_spheres)) {
            if (index.try_emplace(count, all.size()).second) {
                all.push_back({count, budget.max_protrusion, budget.guarantee});
            }
        }
    }
    const std::size_t compared = all.size();
    for (const Budget& budget : budgets) {
        if (!budget.max_spheres) {
            all.push_back(budget);
        }
    }
    std::vector<SphereTree> trees = make(all);
    std::vector<double> claimed(compared);
    parallel_for(compared, [&](std::size_t i) { claimed[i] = union_volume(grown_to_cover(solid, trees[i].finest())); });
    std::vector<SphereTree> result;
    std::size_t without_number = compared;
    for (const Budget& budget : budgets) {
        if (!budget.max_spheres) {
            result.push_back(trees[without_number++]);
            continue;
        }
        std::size_t best = index.at(1);
        for (const std::size_t count : counts_up_to(*budget.max_spheres)) {
            best = claimed[index.at(count)] < claimed[best] ? index.at(count) : best;
        }
        result.push_back(trees[best]);
    }
    return result;
}

} // namespace foam::medial
