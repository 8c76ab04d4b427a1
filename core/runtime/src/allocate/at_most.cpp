#include "allocate/budget.hpp"

#include "allocate/exploration.hpp"

#include <foam/base/internal/ladder.hpp>
#include <foam/base/parallel.hpp>
#include <foam/geometry/volumes.hpp>
#include <foam/runtime/internal/cover.hpp>

#include <algorithm>
#include <bit>
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
    const double volume = geometry::joint_volume(solid, grown_to_cover(solid, tree.finest())); // spheres alone
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

/// Refines a tree to at most `most` spheres. Returns it with an infinite volume if that adds none, nothing if there was
/// no time.
std::optional<Candidate> refined_to(const Workspace& workspace, ShapeWork& work, const SphereTree& tree,
                                    std::size_t most) {
    return measured_in(workspace, [&] {
        SphereTree next = refined(workspace, work, tree, most, Refiners::all);
        return next.finest().size() > tree.finest().size() ? candidate_of(work.shape->original(), std::move(next))
                                                           : Candidate{std::move(next)};
    });
}

/// Replaces the best tree by another if its volume is clearly less: by more than the final growth may add.
void take_if_less(Candidate candidate, Candidate& best) {
    constexpr double clearly = 1e-5;
    if (candidate.volume < (1 - clearly) * best.volume) {
        best = std::move(candidate);
    }
}

/// Refines the best tree up to `limit` spheres, and measures every number of spheres on the way, as more spheres may
/// grow by more in the end. So a larger limit never gives a worse tree. Where one sphere more does not help, the next
/// tries add 2, 4, 8… Ends before a tree of less volume than `floor`.
void refine_up_to(const Workspace& workspace, ShapeWork& work, std::size_t limit, double floor, Candidate& best) {
    SphereTree now = best.tree;
    std::size_t more = 1;
    while (now.finest().size() + more <= limit && !workspace.ended()) {
        std::optional<Candidate> next = refined_to(workspace, work, now, now.finest().size() + more);
        if (!next || next->volume < floor) {
            return;
        }
        if (next->tree.finest().size() <= now.finest().size()) {
            more *= 2;
            continue;
        }
        more = 1;
        now = next->tree;
        take_if_less(std::move(*next), best);
    }
}

/// Returns whether the spherizer reduced the excess volume from one count to the next by so much that spheres added one
/// by one between them rarely reduce it as far. Trees between the counts are then kept from doing so.
bool leaps(const ShapeWork& work, double next, double before) {
    constexpr double leap = 0.7;
    const double solid = work.shape->original().volume();
    return next - solid <= leap * (before - solid);
}

/// The best tree with at most `most` spheres. Up to most_between spheres, the best tree of a count, and the trees that
/// are refined from it, do not depend on `most`. So a larger `most` never gives a worse tree; above, it never gives a
/// worse one than most_between. In the octaves above 8 spheres, the spherizer is also called for the count halfway: 12,
/// 24, 48.
class BestBetween {
public:
    BestBetween(const Workspace& workspace, ShapeWork& work, const std::vector<std::size_t>& counts, std::size_t most)
        : workspace_(workspace), work_(work), counts_(counts), most_(most),
          asked_(candidates(workspace, work, counts)) {}

    SphereTree found() {
        Candidate best = std::move(asked_.front());
        for (std::size_t i = 1; i < counts_.size(); ++i) {
            take(i, best);
        }
        last_between(best);
        return std::move(best.tree);
    }

private:
    static constexpr std::size_t few = 16; ///< counts up to this are always compared: that takes little time
    static constexpr double little_less = 0.97;
    static constexpr double no_floor = 0;

    /// Takes the tree of a count if it is better. Unless it leaps, the trees up to it are refined from the best so far.
    void take(std::size_t i, Candidate& best) {
        const std::size_t count = counts_[i];
        if (count <= few || count > most_between || !leaps(work_, asked_[i].volume, best.volume)) {
            improve_up_to(counts_[i - 1], std::min(count - 1, most_between), no_floor, best);
            if (count <= most_between && asked_[i].volume > little_less * best.volume) {
                refine_up_to(workspace_, work_, count, no_floor, best); // the spherizer itself gains little here
            }
        }
        if (asked_[i].volume < best.volume) {
            best = std::move(asked_[i]);
        }
    }

    /// Improves the best tree of a count up to `limit` spheres, less than twice as many: it is refined, and compared
    /// with the spherizer's own halfway. A larger limit never gives a worse tree. The result has no less volume than
    /// `floor`.
    void improve_up_to(std::size_t count, std::size_t limit, double floor, Candidate& best) {
        const std::size_t halfway = halfway_above(count);
        if (halfway > 0 && halfway <= limit) {
            refine_up_to(workspace_, work_, halfway - 1, floor, best);
            std::optional<Candidate> own = asked(halfway);
            if (own && own->volume >= floor) {
                if (own->volume > little_less * best.volume) {
                    refine_up_to(workspace_, work_, halfway, floor, best);
                }
                if (own->volume < best.volume) {
                    best = std::move(*own);
                }
            }
        }
        refine_up_to(workspace_, work_, limit, floor, best);
    }

    /// Returns the count halfway to the double of a count of counts_alone(); 0 if there is none.
    static std::size_t halfway_above(std::size_t count) {
        constexpr std::size_t first = 8;
        return count >= first && count < most_between && std::has_single_bit(count) ? sparse_rung_above(count) : 0;
    }

    /// Calls the spherizer for one more count. Returns its tree; nothing if there was no time.
    std::optional<Candidate> asked(std::size_t count) {
        const std::vector<std::size_t> counts{count};
        if (!work_.known.asked.contains(count) && !workspace_.ended()) {
            compute_until_cut(workspace_, work_, counts);
        }
        if (!work_.known.asked.contains(count)) {
            return std::nullopt;
        }
        return candidates(workspace_, work_, counts).front();
    }

    /// Improves the best tree up to `most`.
    void last_between(Candidate& best) {
        constexpr double mostly = 0.75;
        if (counts_.back() > most_between) {
            if (static_cast<double>(best.tree.finest().size()) < mostly * static_cast<double>(most_)) {
                // The spherizer gives far less than requested.
                if (auto more = refined_to(workspace_, work_, best.tree, most_)) {
                    take_if_less(std::move(*more), best);
                }
            }
            return;
        }
        const Candidate before = best;
        const std::size_t limit = std::min(most_, most_between);
        improve_up_to(counts_.back(), limit, no_floor, best);
        const std::size_t above = count_after(counts_.back());
        if (limit == most_between || above <= few || !leaps(work_, best.volume, before.volume)) {
            return;
        }
        const std::optional<Candidate> next = asked(above);
        if (next && leaps(work_, next->volume, before.volume) && best.volume < next->volume) {
            best = before; // the next count has no better tree than that
            improve_up_to(counts_.back(), limit, next->volume, best);
        }
    }

    const Workspace& workspace_;
    ShapeWork& work_;
    const std::vector<std::size_t>& counts_;
    std::size_t most_;
    std::vector<Candidate> asked_;
};

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
    return Hasher()
        .add("best of at most, refined up to 64, one by one, with leaps, and halfway")
        .add(tree_key(workspace, work, most))
        .finish();
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
        best.emplace(Cached<SphereTree>{BestBetween(workspace, work, counts, most).found(), {}});
        if (workspace.cut() == Cut::none) {
            workspace.cache.put(key, best->result, {});
        }
    }
    const std::size_t count = best->result.finest().size();
    work.known.trees[count] = std::move(best->result);
    return count;
}

} // namespace foam::inline runtime
