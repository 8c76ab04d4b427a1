#include "at_most.hpp"

#include "exploration.hpp"
#include "refinements.hpp"
#include "trees.hpp"

#include <foam/base/parallel.hpp>
#include <foam/geometry/joint_volume.hpp>
#include <foam/runtime/internal/cover.hpp>

#include <algorithm>
#include <limits>
#include <optional>

namespace foam::inline runtime {
namespace {

struct Candidate {
    SphereTree tree;
    double volume = std::numeric_limits<double>::infinity(); ///< of the union of the grown spheres and the solid, m³
};

/// Returns whether no refinement adds spheres to those of the spherizer: refine.split does so only for covering spheres
/// without half-space constraints.
bool adds_nothing(const Workspace& workspace, const ShapeWork& work) {
    return workspace.recipe.guarantee != Guarantee::outer || !work.clip.empty();
}

bool any_deep(const ShapeWork& work) {
    return std::any_of(work.known.trees.begin(), work.known.trees.end(),
                       [](const auto& known) { return known.second.levels.size() > 2; });
}

Candidate candidate_of(const Solid& solid, SphereTree tree) {
    const double volume = geometry::joint_volume(solid, grown_to_cover(solid, tree.finest()));
    return {std::move(tree), volume};
}

/// Returns the trees of the counts. The volume is infinite where there was no time to compute it.
std::vector<Candidate> candidates(const Workspace& workspace, const ShapeWork& work,
                                  const std::vector<std::size_t>& counts) {
    std::vector<Candidate> result(counts.size());
    parallel_for(counts.size(), [&](std::size_t i) {
        const SphereTree& tree = work.known.trees.at(work.known.asked.at(counts[i]));
        const auto candidate = [&] { return candidate_of(work.shape->original(), tree); };
        if (i == 0) { // without the first candidate there is no result
            result[i] = candidate();
        } else if (auto made = measured_in(workspace.in(Phase::beginning), candidate)) {
            result[i] = std::move(*made);
        }
    });
    return result;
}

/// Refines the best tree up to `limit` spheres. Keeps a result only if its volume is clearly less: by more than the
/// final growth may add.
void refine_up_to(const Workspace& workspace, ShapeWork& work, std::size_t limit, Candidate& best) {
    constexpr double clearly = 1e-5;
    if (best.tree.finest().size() >= limit || workspace.ended()) {
        return;
    }
    auto more = measured_in(workspace, [&] {
        return candidate_of(work.shape->original(), refined(workspace, work, best.tree, limit, Refiners::all));
    });
    if (more && more->volume < (1 - clearly) * best.volume) {
        best = std::move(*more);
    }
}

/// Returns the best tree with at most `most` spheres. Up to most_between spheres, the best tree of a count, and the
/// trees that are refined from it, do not depend on `most`. So a larger `most` never gives a worse tree; above, it
/// never gives a worse one than most_between.
SphereTree with_more_between(const Workspace& workspace, ShapeWork& work, const std::vector<std::size_t>& counts,
                             std::size_t most) {
    constexpr double little_less = 0.97, mostly = 0.75;
    std::vector<Candidate> asked = candidates(workspace, work, counts);
    Candidate best = std::move(asked.front());
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const bool few = counts[i] <= most_between;
        if (i > 0 && few && asked[i].volume > little_less * best.volume) {
            refine_up_to(workspace, work, counts[i], best); // the spherizer itself gains little here
        }
        if (i > 0 && asked[i].volume < best.volume) {
            best = std::move(asked[i]);
        }
        const std::size_t next = i + 1 < counts.size() ? counts[i + 1] - 1 : most;
        if (few) {
            refine_up_to(workspace, work, std::min(next, most_between), best);
        } else if (best.tree.finest().size() < mostly * static_cast<double>(most)) {
            refine_up_to(workspace, work, most, best); // the spherizer gives far less than requested
        }
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
    if ((adds_nothing(workspace, work) || any_deep(work)) && counts.back() != most) {
        counts.push_back(most);
        compute_until_cut(workspace, work, {most});
    }
    std::erase_if(counts, [&](std::size_t count) { return !work.known.asked.contains(count); });
    return counts;
}

Digest best_key(const Workspace& workspace, const ShapeWork& work, std::size_t most) {
    return Hasher().add("best of at most, refined up to 64").add(tree_key(workspace, work, most)).finish();
}

} // namespace

std::size_t best_of_at_most(const Workspace& workspace, ShapeWork& work, std::size_t most) {
    const std::vector<std::size_t> counts = computed(workspace, work, most);
    if (adds_nothing(workspace, work)) {
        return best_of(workspace, work, counts);
    }
    if (counts.back() == 1 || !(work.shape->original().bounds().diagonal() > 0)) {
        return work.known.asked.at(counts.front());
    }
    const Digest key = best_key(workspace, work, most);
    std::optional<Cached<SphereTree>> best = workspace.cache.tree(key);
    if (!best) {
        best.emplace(Cached<SphereTree>{with_more_between(workspace, work, counts, most), {}});
        if (workspace.cut() == Cut::none) {
            workspace.cache.put(key, best->result, {});
        }
    }
    const std::size_t count = best->result.finest().size();
    work.known.trees[count] = std::move(best->result);
    return count;
}

} // namespace foam::runtime
