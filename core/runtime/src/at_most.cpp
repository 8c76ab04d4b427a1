#include "at_most.hpp"

#include "exploration.hpp"
#include "trees.hpp"

#include <foam/base/parallel.hpp>
#include <foam/geometry/internal/joint_volume.hpp>
#include <foam/geometry/internal/row_cover.hpp>
#include <foam/runtime/internal/cover.hpp>
#include <foam/search/internal/splitting.hpp>

#include <algorithm>
#include <limits>
#include <optional>

namespace foam::inline runtime {
namespace {

struct Candidate {
    SphereTree tree;                                         ///< from the spherizer, or split from such a tree
    std::vector<Sphere> grown;                               ///< the finest level, grown to cover the solid
    double volume = std::numeric_limits<double>::infinity(); ///< of the union of these spheres and the solid, m³
};

/// Returns whether splitting is impossible: its spheres always cover, and it does not know half-space constraints.
bool splits_nothing(const Workspace& workspace, const ShapeWork& work) {
    return workspace.recipe.guarantee != Guarantee::outer || !work.clip.empty();
}

bool any_deep(const ShapeWork& work) {
    return std::any_of(work.known.trees.begin(), work.known.trees.end(),
                       [](const auto& known) { return known.second.levels.size() > 2; });
}

/// Returns the trees of the counts with the volume of their grown spheres. The volume is infinite where there was no
/// time to compute it.
std::vector<Candidate> candidates(const Workspace& workspace, const ShapeWork& work,
                                  const std::vector<std::size_t>& counts) {
    std::vector<Candidate> result(counts.size());
    parallel_for(counts.size(), [&](std::size_t i) {
        const auto candidate = [&] {
            Candidate made;
            made.tree = work.known.trees.at(work.known.asked.at(counts[i]));
            made.grown = grown_to_cover(work.shape->original(), made.tree.finest());
            made.volume = geometry::joint_volume(work.shape->original(), made.grown);
            return made;
        };
        if (i == 0) { // without the first candidate there is no result
            result[i] = candidate();
        } else if (auto made = measured_in(workspace.in(Phase::beginning), candidate)) {
            result[i] = std::move(*made);
        }
    });
    return result;
}

/// Returns a tree of two levels with the root of `tree`.
SphereTree with_finest(const SphereTree& tree, std::vector<Sphere> spheres) {
    SphereTree result = flat_tree(std::move(spheres));
    if (tree.levels.size() > 1) {
        result.levels.front() = tree.levels.front();
    }
    return result;
}

/// Splits spheres of the best candidate up to `count` spheres. Keeps a result only if its volume is clearly less: by
/// more than the final growth may add. On the way the volume may rise: around a ring, two spheres have more excess
/// volume than one. `splitting` is made before the first split.
void split_up_to(const Workspace& workspace, const Solid& solid, std::optional<cover::Splitting>& splitting,
                 std::size_t count, Candidate& best) {
    constexpr double clearly = 1e-5;
    Candidate next = best;
    while (next.tree.levels.size() <= 2 && next.grown.size() < count && !workspace.ended()) {
        if (!splitting) {
            measured_in(workspace, [&] { return &splitting.emplace(solid); });
        }
        if (!splitting) {
            return;
        }
        auto more = measured_in(workspace, [&] { return splitting->one_more(next.grown, next.volume); });
        if (!more || more->spheres.size() == next.grown.size()) {
            return;
        }
        next.volume = more->volume;
        next.tree = with_finest(next.tree, more->spheres);
        next.grown = std::move(more->spheres);
        if (next.volume < (1 - clearly) * best.volume) {
            best = next;
        }
    }
}

/// Returns the best tree with at most `most` spheres. The best tree of a count, and the trees that are split from it,
/// do not depend on `most`. So a larger `most` never gives a worse tree.
SphereTree with_splits_between(const Workspace& workspace, const ShapeWork& work,
                               const std::vector<std::size_t>& counts, std::size_t most) {
    std::vector<Candidate> asked = candidates(workspace, work, counts);
    const Solid& solid = work.shape->original();
    std::optional<cover::Splitting> splitting;
    Candidate best;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (asked[i].volume < best.volume) {
            best = std::move(asked[i]);
        }
        split_up_to(workspace, solid, splitting, i + 1 < counts.size() ? counts[i + 1] - 1 : most, best);
    }
    if (auto row = geometry::row_cover(solid, most); row && geometry::joint_volume(solid, *row) < best.volume) {
        return flat_tree(std::move(*row));
    }
    return std::move(best.tree);
}

std::size_t best_of(const Workspace& workspace, const ShapeWork& work, const std::vector<std::size_t>& counts) {
    std::vector<double> cost(counts.size(), std::numeric_limits<double>::infinity());
    parallel_for(counts.size(), [&](std::size_t i) {
        const SphereTree& tree = work.known.trees.at(work.known.asked.at(counts[i]));
        const auto wrong = [&] {
            return cost_volume(work.shape->original(), tree.finest(), workspace.recipe.guarantee);
        };
        cost[i] = measured_in(workspace.in(Phase::beginning), wrong).value_or(cost[i]);
    });
    return work.known.asked.at(
        counts[static_cast<std::size_t>(std::min_element(cost.begin(), cost.end()) - cost.begin())]);
}

/// Calls the spherizer. Returns the counts that are known then: fewer than requested if the search ended early.
std::vector<std::size_t> computed(const Workspace& workspace, ShapeWork& work, std::size_t most) {
    std::vector<std::size_t> counts = counts_alone(std::min(work.least, most), most);
    if (workspace.time_limit()) { // a single call for all counts would have no result at the time limit
        for (const std::size_t count : counts) {
            compute_until_cut(workspace, work, {count});
        }
    } else {
        compute_until_cut(workspace, work, counts);
    }
    if ((splits_nothing(workspace, work) || any_deep(work)) && counts.back() != most) {
        counts.push_back(most);
        compute_until_cut(workspace, work, {most});
    }
    std::erase_if(counts, [&](std::size_t count) { return !work.known.asked.contains(count); });
    return counts;
}

Digest best_key(const Workspace& workspace, const ShapeWork& work, std::size_t most) {
    return Hasher().add("best of at most, with the solid").add(tree_key(workspace, work, most)).finish();
}

} // namespace

std::size_t best_of_at_most(const Workspace& workspace, ShapeWork& work, std::size_t most) {
    const std::vector<std::size_t> counts = computed(workspace, work, most);
    if (splits_nothing(workspace, work)) {
        return best_of(workspace, work, counts);
    }
    if (counts.back() == 1 || !(work.shape->original().bounds().diagonal() > 0)) {
        return work.known.asked.at(counts.front());
    }
    const Digest key = best_key(workspace, work, most);
    std::optional<Cached<SphereTree>> best = workspace.cache.tree(key);
    if (!best) {
        best.emplace(Cached<SphereTree>{with_splits_between(workspace, work, counts, most), {}});
        if (workspace.cut() == Cut::none) {
            workspace.cache.put(key, best->result, {});
        }
    }
    const std::size_t count = best->result.finest().size();
    work.known.trees[count] = std::move(best->result);
    return count;
}

} // namespace foam::runtime
