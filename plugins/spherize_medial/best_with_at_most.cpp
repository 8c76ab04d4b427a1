#include "best_with_at_most.hpp"

#include <foam/base/parallel.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/geometry/volumes.hpp>

#include <map>
#include <set>

namespace foam::medial {

/// Share of the volume of one ball: spheres with less volume before they grow also have less afterwards, because a
/// method's spheres nearly cover. Growing is the expensive part.
static constexpr double clearly_less = 0.75;

/// Returns the volume by which the runtime compares covering spheres: of the union of spheres and solid, m³. So a
/// cavity is no gain.
static double joint_volume(const Solid& solid, const std::vector<Sphere>& spheres) {
    return exact_union_volume(spheres) + solid.missing_volume(spheres);
}

std::vector<std::size_t> many_fewer(std::size_t most) {
    std::vector<std::size_t> counts;
    for (std::size_t count = 1; count < most;
         count = count < 12 ? count + 1 : (count % 3 == 0 ? count / 3 * 4 : count / 2 * 3)) {
        counts.push_back(count);
    }
    counts.push_back(most);
    return counts;
}

std::vector<std::size_t> one_or_all(std::size_t most) {
    constexpr std::size_t few = 4;
    return most > 1 && most <= few ? std::vector<std::size_t>{1, most} : std::vector<std::size_t>{most};
}

std::vector<SphereTree> best_with_at_most(const Solid& solid, std::span<const Budget> budgets, const Counts& counts,
                                          const Maker& make) {
    std::vector<Budget> all;
    std::map<std::size_t, std::size_t> index; // of a count in `all`
    std::set<std::size_t> compared;           // indices
    bool with_one_only = true;
    for (const Budget& budget : budgets) {
        if (!budget.max_spheres) {
            continue;
        }
        const std::vector<std::size_t> list = counts(*budget.max_spheres);
        for (const std::size_t count : list) {
            if (index.try_emplace(count, all.size()).second) {
                all.push_back({count, budget.max_protrusion, budget.guarantee});
            }
            if (list.size() > 1) {
                compared.insert(index.at(count));
            }
        }
        with_one_only = with_one_only && list.size() <= 2;
    }
    const std::size_t numbers = all.size();
    for (const Budget& budget : budgets) {
        if (!budget.max_spheres) {
            all.push_back(budget);
        }
    }
    std::vector<SphereTree> trees = make(all);
    const double clear =
        with_one_only && !compared.empty() ? clearly_less * joint_volume(solid, trees[index.at(1)].finest()) : 0;
    std::vector<double> claimed(numbers);
    parallel_for(numbers, [&](std::size_t i) {
        if (compared.contains(i)) {
            claimed[i] = joint_volume(solid, trees[i].finest());
            if (claimed[i] >= clear) {
                claimed[i] = joint_volume(solid, grown_to_cover(solid, trees[i].finest()));
            }
        }
    });
    std::vector<SphereTree> result;
    std::size_t without_number = numbers;
    for (const Budget& budget : budgets) {
        if (!budget.max_spheres) {
            result.push_back(trees[without_number++]);
            continue;
        }
        const std::vector<std::size_t> list = counts(*budget.max_spheres);
        std::size_t best = index.at(list.front());
        for (const std::size_t count : list) {
            best = claimed[index.at(count)] < claimed[best] ? index.at(count) : best;
        }
        result.push_back(trees[best]);
    }
    return result;
}

} // namespace foam::medial
