#include "allocate/exploration.hpp"

#include <foam/geometry/inner.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/runtime/internal/cover.hpp>
#include <foam/sdk/kinds.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace foam::inline runtime {

/// Returns the groups whose shape has no error.
std::vector<std::size_t> allocated_groups(const std::vector<ShapeWork>& shapes, const std::vector<Group>& groups) {
    std::vector<std::size_t> allocated_groups;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        if (!shapes[groups[g].shape].error) {
            allocated_groups.push_back(g);
        }
    }
    return allocated_groups;
}

std::size_t most_of(const Recipe& recipe, const ShapeWork& work) {
    constexpr std::size_t most_unasked = 256;
    return work.most == SIZE_MAX && !total_of(recipe) ? std::max(work.least, most_unasked) : work.most;
}

bool has_fixed_count(const Recipe& recipe, const ShapeWork& shape, std::size_t groups) {
    return !recipe.budget_excess && !shape.max_protrusion && (groups == 1 || !total_of(recipe));
}

std::size_t fixed_count(const Recipe& recipe, const ShapeWork& shape) {
    return std::min(shape.most, total_of(recipe).value_or(SIZE_MAX));
}

std::vector<std::size_t> rungs_above(const ShapeWork& shape, std::size_t explored, std::size_t most) {
    const Rungs kind = spheres_alone(shape.kinds) ? Rungs::dense : Rungs::sparse;
    if (shape.unit == 1) {
        return next_rungs(explored, shape.least, most, kind);
    }
    const auto in_units = [&](std::size_t count) { return count / shape.unit + (count % shape.unit > 0 ? 1 : 0); };
    std::vector<std::size_t> rungs = next_rungs(in_units(explored), in_units(shape.least), in_units(most), kind);
    for (std::size_t& rung : rungs) {
        rung = std::min(rung * shape.unit, most);
    }
    return rungs;
}

std::vector<std::size_t> first_counts(const Recipe& recipe, const ShapeWork& shape, std::size_t groups) {
    if (has_fixed_count(recipe, shape, groups)) {
        const std::size_t most = fixed_count(recipe, shape);
        if (most == SIZE_MAX || !shape.adds_spheres || !wants_least_excess(recipe, shape)) {
            return {most == SIZE_MAX ? 0 : std::max(shape.least, most)};
        }
        return counts_alone(shape.least, std::max(shape.least, most));
    }
    const std::optional<std::size_t> total = total_of(recipe);
    if (!total && !recipe.budget_excess) {
        return {shape.least};
    }
    std::vector<std::size_t> counts = rungs_above(shape, 0, most_of(recipe, shape));
    if (groups == 1 && total) {
        std::erase_if(counts, [&](std::size_t count) { return count > *total; });
    }
    return counts;
}

/// Calls compute_trees(), until the phase ends.
static void compute_in_time(const Workspace& workspace, ShapeWork& work, const std::vector<std::size_t>& counts) {
    try {
        compute_trees(workspace, work, counts);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::cancelled || !workspace.ended()) {
            throw;
        }
    }
}

/// Uses one enclosing sphere where there is no time for the spherizer to make any.
static void take_enclosing_ball(const Workspace& workspace, ShapeWork& work) {
    workspace.in(Phase::preparing).check_cancelled();
    if (workspace.recipe.guarantee == Guarantee::inner) {
        throw Error(ErrorCode::geometry, fmt::format("stage '{}', link '{}': no sphere was found within the time limit "
                                                     "of {} s; remedy: more time",
                                                     work.spherizer.stage, work.link, *workspace.time_limit()));
    }
    const Sphere ball = minimum_enclosing_sphere(work.shape->original().surface().vertices);
    SphereTree tree = flat_tree({ball});
    const std::size_t size = size_of(workspace.recipe, tree.elements());
    work.known.asked[work.least] = size;
    work.known.trees[size] = std::move(tree);
    workspace.journal.finding(
        {Severity::warning, work.link, work.spherizer.stage,
         fmt::format("it found no spheres within the time limit of {} s; one enclosing sphere replaces them",
                     *workspace.time_limit())});
}

/// Finishes spheres of a shape as if they were the result, to measure the time that takes.
static void try_to_finish(const Workspace& workspace, ShapeWork& work) {
    const double begin = workspace.journal.seconds();
    try {
        const Solid& solid = work.shape->original();
        const StopScope scope(workspace.in(Phase::beginning).request());
        const FinishedTree tree = finished_tree(solid, work.known.trees.begin()->second, workspace.recipe.guarantee);
        measure(solid, tree.tree.elements());
    } catch (const Error&) {
        // Errors are reported where the result is finished. The time was spent all the same.
    }
    workspace.limits->add_to_reserve(workspace.journal.seconds() - begin, work.groups.size(), thread_count());
    work.tried_to_finish = true;
}

void compute_until_cut(const Workspace& workspace, ShapeWork& work, const std::vector<std::size_t>& counts) {
    compute_in_time(workspace, work, counts);
    if (work.known.trees.empty() && workspace.cut() == Cut::time_limit) {
        workspace.journal.expect(1);
        compute_in_time(workspace.in(Phase::beginning), work, {work.least});
        if (work.known.trees.empty()) {
            take_enclosing_ball(workspace, work);
        }
    }
    if (work.known.trees.empty()) {
        throw Error(ErrorCode::cancelled, "cancelled; nothing was written");
    }
    if (workspace.time_limit() && !work.tried_to_finish && !workspace.ended()) {
        try_to_finish(workspace, work);
    }
}

/// Returns the cost of a tree once the guarantee is kept.
static Cost cost_of(const Workspace& workspace, const ShapeWork& work, const SphereTree& tree) {
    const Solid& solid = work.shape->original();
    const Guarantee guarantee = workspace.recipe.guarantee;
    Cost cost;
    cost.volume = cost_of_elements(solid, tree.elements(), guarantee);
    if (work.max_protrusion) {
        cost.over = std::max(0.0, protrusion_of_elements(solid, tree.elements(), guarantee) - *work.max_protrusion);
    }
    cost.over += std::max(0.0, violation_of(work.clip, tree.elements()));
    return cost;
}

Cut explore(const Workspace& workspace, std::vector<ShapeWork>& shapes,
            const std::vector<std::vector<std::size_t>>& counts) {
    for (std::size_t s = 0; s < shapes.size(); ++s) {
        workspace.journal.expect(counts[s].empty() ? 0 : 1);
    }
    for_each_shape(shapes, [&](std::size_t s) { compute_until_cut(workspace, shapes[s], counts[s]); });
    const Cut cut = workspace.cut();
    const bool all = measure_trees(
        workspace, shapes, [&](std::size_t s, std::size_t count) { return shapes[s].known.curve.knows(count); },
        [&](std::size_t s) { return shapes[s].known.curve.known().empty(); },
        [&](const ShapeWork& work, const SphereTree& tree) { return cost_of(workspace, work, tree); },
        [&](std::size_t s, std::size_t count, const Cost& cost) { shapes[s].known.curve.set(count, cost); });
    return all ? cut : workspace.cut();
}

namespace {

/// Returns the power of the count with which a shape's costs fell over the last doubling of its count. If half the
/// count is not known, the next smaller known count takes its place, or else the smallest.
double power_of_last_doubling(const ShapeWork& work, std::size_t explored) {
    const std::map<std::size_t, Cost>& known = work.known.curve.known();
    const auto above = known.upper_bound(explored / 2);
    const auto& [count, cost] = *(above == known.begin() ? above : std::prev(above));
    const double now = work.known.curve.least().volume;
    return count < explored && now > 0 ? std::log(std::max(cost.volume / now, 1.0)) /
                                             std::log(static_cast<double>(explored) / static_cast<double>(count))
                                       : 0;
}

/// Returns the power of the count with which a shape's costs are expected to fall. On links of robots, costs of spheres
/// were observed to fall as count^-0.4, and faster for the first few: one sphere suits hardly any link. Then they are
/// expected to fall as they did last, and by less beyond eight: counts that no link gets in the end take much of a run's
/// time. Other elements differ more: what was seen of the shape counts, beside one doubling at the usual power.
double expected_power(const ShapeWork& work, std::size_t explored) {
    constexpr double steep = 0.7, usual = 0.4, flattest = 0.25, steepest = 0.6, less = 0.7;
    constexpr double doubling = std::numbers::ln2;
    constexpr std::size_t few = 2, some = 4, several = 8;
    if (spheres_alone(work.kinds)) {
        if (explored <= some) {
            return explored <= few ? steep : usual;
        }
        const double last = std::clamp(power_of_last_doubling(work, explored), flattest, steepest);
        return explored <= several ? last : less * last;
    }
    const double first = work.known.curve.known().begin()->second.volume, now = work.known.curve.least().volume;
    const double fallen = now > 0 ? std::log(std::max(first / now, 1.0)) : 0;
    const double seen = std::log(static_cast<double>(explored) / static_cast<double>(work.least));
    return (usual * doubling + fallen) / (doubling + std::max(seen, 0.0));
}

/// Returns the expected reduction of excess volume by one more element, m³. Excess volume in a cavity hardly falls:
/// only elements much smaller than the cavity leave it free.
double expected_gain(const Recipe& recipe, const ShapeWork& work) {
    constexpr double least_share = 0.05;
    const std::size_t explored = work.known.asked.rbegin()->first;
    const double wrong = work.known.curve.least().volume;
    const double may_fall = std::max(wrong - work.cavities, least_share * wrong);
    return explored < most_of(recipe, work) ? expected_power(work, explored) * may_fall / static_cast<double>(explored)
                                            : 0;
}

class Exploration {
public:
    Exploration(const Workspace& workspace, std::vector<ShapeWork>& shapes, const std::vector<Group>& groups,
                const Goal& goal)
        : workspace_(workspace), shapes_(shapes), groups_(groups), goal_(goal), weights_(shapes.size(), 0) {
        for (const Group& group : groups) {
            weights_[group.shape] = std::max(weights_[group.shape], group.weight);
            least_ += shapes[group.shape].least;
        }
    }

    /// Explores the curves as far as the goal needs: with more elements the same counts are known and perhaps more, and
    /// the best allocation is never worse. A search for elements other than spheres takes long. Those are explored for
    /// each number up to the goal's in turn, and never with more than the others leave to one shape at its price.
    Cut run() {
        std::vector<std::vector<std::size_t>> first(shapes_.size());
        for (std::size_t s = 0; s < shapes_.size(); ++s) {
            first[s] = nothing_to_choose() ? std::vector{shapes_[s].least}
                                           : first_counts(workspace_.recipe, shapes_[s], groups_.size());
        }
        in_turn_ = can_take_turns();
        most_ = in_turn_ ? least_ : goal_.most;
        Cut cut = explore_from(first);
        while (most_ < goal_.most && cut == Cut::none) {
            ++most_;
            cut = explore_from(next());
        }
        return cut;
    }

private:
    /// Returns whether the exploration is for every number up to the goal's in turn; turns cost time as well.
    bool can_take_turns() const {
        constexpr std::size_t most_turns = 10'000;
        return goal_.most >= least_ && goal_.most - least_ <= most_turns && !goal_.enough && groups_.size() > 1 &&
               std::none_of(shapes_.begin(), shapes_.end(),
                            [](const ShapeWork& shape) { return shape.unit != 1 || spheres_alone(shape.kinds); });
    }

    /// Explores these counts, and then others for the present number of elements. Shapes that do not keep their limit
    /// come first. After that, always the shape where one more element is expected to save most. The exploration ends
    /// when, at the price of that saving, the shapes would take all available elements, or as many as are enough for
    /// the goal. The goal decides only when the exploration ends, not its order.
    Cut explore_from(std::vector<std::vector<std::size_t>> wanted) {
        Cut cut = Cut::none;
        while (!wanted.empty() && cut == Cut::none) {
            cut = explore(workspace_, shapes_, wanted);
            workspace_.journal.round(explored_share());
            wanted = next();
        }
        return cut;
    }

    /// Returns the counts of each shape that the present number of elements needs known. Empty: none.
    std::vector<std::vector<std::size_t>> next() const {
        std::vector<std::vector<std::size_t>> wanted = rungs_over_limit();
        return wanted.empty() && !nothing_to_choose() ? rungs_that_save() : wanted;
    }

    /// Returns whether the budget is just enough for the least count of every group.
    bool nothing_to_choose() const { return groups_.size() > 1 && goal_.most == least_; }

    /// Returns the progress: the share of the available spheres that the shapes were explored with.
    double explored_share() const {
        double explored = 0;
        for (const std::size_t g : allocated_groups(shapes_, groups_)) {
            const auto& asked = shapes_[groups_[g].shape].known.asked;
            explored += asked.empty() ? 0 : static_cast<double>(asked.rbegin()->first);
        }
        return std::min(0.95, explored / static_cast<double>(goal_.most));
    }

    double gain(std::size_t s) const {
        const double expected = weights_[s] * expected_gain(workspace_.recipe, shapes_[s]);
        if (!in_turn_) {
            return expected;
        }
        const std::vector<std::size_t> next = rungs(s);
        return next.empty() || next.front() > left_by_others(s, expected) ? 0 : expected;
    }
    /// Returns how many elements the other groups leave to a shape if each saves `price` at first. They give up those
    /// that save less than half as much again.
    std::size_t left_by_others(std::size_t s, double price) const {
        constexpr double worth = 1.5; // expectations are rough
        std::size_t others = 0;
        bool itself = true;
        for (const std::size_t g : allocated_groups(shapes_, groups_)) {
            if (!(itself && groups_[g].shape == s)) {
                others += shapes_[groups_[g].shape].known.curve.demand(worth * price, groups_[g].weight);
            }
            itself = itself && groups_[g].shape != s;
        }
        return most_ - std::min(most_, others);
    }

    /// Returns the next candidate counts of a shape, beyond the first few one at once: further ones are often not
    /// needed.
    std::vector<std::size_t> rungs(std::size_t s) const {
        constexpr std::size_t first_few = 4;
        const ShapeWork& shape = shapes_[s];
        const std::size_t explored = shape.known.asked.rbegin()->first;
        std::vector<std::size_t> rungs = rungs_above(shape, explored, most_of(workspace_.recipe, shape));
        if (explored >= first_few * shape.unit && rungs.size() > 1) {
            rungs.resize(1);
        }
        if (in_turn_) { // the others take their least count
            std::erase_if(rungs, [&](std::size_t count) { return count > most_ - (least_ - shape.least); });
        }
        return rungs;
    }

    /// Returns the next candidate counts of shapes that keep their limit with no known count. Empty: none of them could
    /// have more spheres.
    std::vector<std::vector<std::size_t>> rungs_over_limit() const {
        std::vector<std::vector<std::size_t>> wanted(shapes_.size());
        bool any = false;
        for (std::size_t s = 0; s < shapes_.size(); ++s) {
            const ShapeWork& work = shapes_[s];
            // The other shapes take their least count.
            if (!work.error && work.known.curve.least().over > 0 &&
                least_ - work.least + work.known.asked.rbegin()->first < most_) {
                wanted[s] = rungs(s);
                any = any || !wanted[s].empty();
            }
        }
        return any ? wanted : std::vector<std::vector<std::size_t>>{};
    }

    /// Returns the next candidate counts of the shapes where one more element is expected to save most, or nearly as
    /// much, to use all cores. Empty: the exploration is complete.
    std::vector<std::vector<std::size_t>> rungs_that_save() const {
        const std::vector<std::size_t> allocated_groups = foam::allocated_groups(shapes_, groups_);
        double price = 0;
        std::size_t explored = 0; // of the shape that may save most
        for (const std::size_t g : allocated_groups) {
            if (const double saved = gain(groups_[g].shape); saved > price) {
                price = saved;
                explored = shapes_[groups_[g].shape].known.asked.rbegin()->first;
            }
        }
        std::size_t demand = 0;
        for (const std::size_t g : allocated_groups) {
            demand += shapes_[groups_[g].shape].known.curve.demand(price, groups_[g].weight);
        }
        const std::size_t total = total_wanted();
        if (price <= least_price() || demand >= total || explored >= total) {
            return {};
        }
        const double nearly = in_turn_ ? 0.9 : 0.8; // a search that is not needed takes long, where turns are taken
        std::vector<std::vector<std::size_t>> wanted(shapes_.size());
        for (std::size_t s = 0; s < shapes_.size(); ++s) {
            if (!shapes_[s].error && gain(s) >= nearly * price) {
                wanted[s] = rungs(s);
            }
        }
        return wanted;
    }

    /// Returns the price below which it is not worth exploring for elements other than spheres: a small share of what
    /// is wrong with an element on average.
    double least_price() const {
        constexpr double small = 0.05;
        double wrong = 0;
        for (const std::size_t g : allocated_groups(shapes_, groups_)) {
            wrong += groups_[g].weight * shapes_[groups_[g].shape].known.curve.least().volume;
        }
        return in_turn_ ? small * wrong / static_cast<double>(most_) : 0;
    }

    std::size_t total_wanted() const {
        const Shared shared = goal_.enough ? share(shapes_, groups_, goal_) : Shared{};
        return shared.enough ? std::accumulate(shared.counts.begin(), shared.counts.end(), std::size_t{0}) : most_;
    }

    const Workspace& workspace_;
    std::vector<ShapeWork>& shapes_;
    const std::vector<Group>& groups_;
    const Goal& goal_;
    std::vector<double> weights_; ///< of each shape, the largest of its groups
    std::size_t least_ = 0;       ///< number of elements that all groups need
    std::size_t most_ = 0;        ///< number of elements that is explored for at present
    bool in_turn_ = false;        ///< whether it is every number up to the goal's in turn
};

/// Bisects between two candidate counts for the fewest spheres that are enough, for a single group.
Cut narrow_down(const Workspace& workspace, std::vector<ShapeWork>& shapes, const Goal& goal) {
    const ShapeWork& work = shapes.front();
    if (!goal.enough) {
        return Cut::none;
    }
    const auto enough = [&](const Cost& cost) {
        return cost.over <= work.known.curve.least().over && cost.volume <= *goal.enough;
    };
    Cut cut = Cut::none;
    while (cut == Cut::none && !work.error) {
        std::size_t low = 0, high = 0; // the largest requested count that is not enough, and the smallest that is
        for (const auto& [asked, got] : work.known.asked) {
            if (enough(work.known.curve.known().at(got))) {
                high = asked;
                break;
            }
            low = asked;
        }
        if (high <= low + work.unit || high <= work.least) {
            break;
        }
        cut = explore(workspace, shapes, {{(low + high) / 2}});
    }
    return cut;
}

} // namespace

Cut explore_for(const Workspace& workspace, std::vector<ShapeWork>& shapes, const std::vector<Group>& groups,
                const Goal& goal) {
    const bool alone = groups.size() == 1;
    if (alone) {
        shapes.front().most = std::min(shapes.front().most, goal.most);
    }
    Cut cut = Exploration(workspace, shapes, groups, goal).run();
    if (alone && cut == Cut::none) {
        cut = narrow_down(workspace, shapes, goal);
    }
    return cut;
}

} // namespace foam::inline runtime
