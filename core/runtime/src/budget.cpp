#include "budget.hpp"

#include "at_most.hpp"
#include "separation.hpp"
#include "worst_first.hpp"

#include <foam/runtime/internal/cover.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>

namespace foam::inline runtime {
namespace {

void say_if_not_all(const Workspace& workspace, std::size_t used, std::size_t total) {
    if (used > 0 && used < total) {
        workspace.journal.finding(
            {Severity::warning, "", "",
             fmt::format("{} of {} spheres are used; more spheres did not reduce the excess of these links", used,
                         total)});
    }
}

/// Reports where the allocation differs from the budget.
void report_allocation(const Workspace& workspace, const std::vector<LinkWork>& links,
                       const std::vector<ShapeWork>& shapes, const std::vector<Group>& groups,
                       const std::vector<std::size_t>& counts, double volume, bool enough, Cut cut) {
    const Recipe& recipe = workspace.recipe;
    std::size_t sum = 0;
    double wrong = 0;
    for (const std::size_t g : allocated_groups(shapes, groups)) {
        const ShapeWork& work = shapes[groups[g].shape];
        const Cost cost = work.known.curve.known().at(counts[g]);
        sum += counts[g];
        wrong += cost.volume;
        const SphereTree& tree = work.known.trees.at(counts[g]);
        const double protrudes = cost.over - std::max(0.0, violation_of(work.clip, tree.finest()));
        if (work.max_protrusion && protrudes > 0) {
            workspace.journal.finding(
                {Severity::warning, links[groups[g].link].link->name, work.spherizer.stage,
                 fmt::format("its spheres ({}) protrude by {:.3g} m, max_protrusion allows {:.3g} "
                             "m; remedy: {}",
                             counts[g], *work.max_protrusion + protrudes, *work.max_protrusion,
                             cut == Cut::none ? "more spheres for the robot or for this link" : "more time")});
        }
    }
    if (sum == 0) {
        return;
    }
    if (recipe.budget_excess && !enough) {
        workspace.journal.finding(
            {Severity::warning, "", "",
             fmt::format("budget.excess: {} is not reached: with {} spheres it is {:.3g}; remedy: {}",
                         to_text(*recipe.budget_excess), sum, wrong / volume,
                         cut != Cut::none        ? "more time"
                         : recipe.budget_spheres ? "raise budget.spheres"
                                                 : "raise max_spheres of the links")});
    } else if (recipe.budget_spheres && !recipe.budget_excess && cut == Cut::none) {
        say_if_not_all(workspace, sum, *recipe.budget_spheres);
    }
}

/// Returns the volume of the groups' geometry, m³.
double volume_of(const std::vector<ShapeWork>& shapes, const std::vector<Group>& groups) {
    const std::vector<std::size_t> taking = allocated_groups(shapes, groups);
    std::vector<double> volumes(taking.size());
    parallel_for(taking.size(),
                 [&](std::size_t i) { volumes[i] = shapes[groups[taking[i]].shape].shape->original().volume(); });
    return std::accumulate(volumes.begin(), volumes.end(), 0.0);
}

/// Returns the count of every group, 0 for those with an error. With a number of spheres as budget: at most that many,
/// with the least weighted cost. With an excess as budget: the fewest that keep it.
ChosenCounts share_spheres(const Workspace& workspace, const std::vector<LinkWork>& links,
                           std::vector<ShapeWork>& shapes, const std::vector<Group>& groups, ReferencePose* pose) {
    const Recipe& recipe = workspace.recipe;
    Goal goal;
    goal.most = recipe.budget_spheres.value_or(SIZE_MAX);
    const double volume = volume_of(shapes, groups);
    if (recipe.budget_excess) {
        if (volume == 0 && !allocated_groups(shapes, groups).empty()) {
            throw Error(ErrorCode::recipe, "budget.excess: the geometry has no volume to compare with; remedy: budget: "
                                           "{spheres: …} or {max_protrusion: …}");
        }
        goal.enough = *recipe.budget_excess * volume;
    }
    ChosenCounts chosen;
    const std::optional<Objective> objective =
        goal.enough || pose ? std::nullopt : common_objective(workspace.recipe, shapes);
    Shared shared;
    if (objective) {
        Figures figures;
        chosen.cut = explore_worst_first(workspace, shapes, groups, *objective, goal.most, figures);
        shared = share(shapes, groups, goal, bounds_of_best_worst(shapes, groups, figures, goal.most));
    } else {
        chosen.cut = explore_for(workspace, shapes, groups, goal);
        shared = share(shapes, groups, goal);
    }
    if (pose && !shared.counts.empty()) {
        shared = keep_apart(workspace, shapes, groups, goal, *pose, std::move(shared), chosen.cut);
    }
    chosen.of_group.assign(groups.size(), 0);
    const std::vector<std::size_t> allocated_groups = foam::allocated_groups(shapes, groups);
    for (std::size_t i = 0; i < shared.counts.size(); ++i) {
        chosen.of_group[allocated_groups[i]] = shared.counts[i];
    }
    report_allocation(workspace, links, shapes, groups, chosen.of_group, volume, shared.enough, chosen.cut);
    return chosen;
}

/// Returns the fewest spheres whose protrusion is within the limit, by doubling and bisection. If the search ends
/// early: the fewest that were found to keep the limit, else the most that were tried.
std::size_t count_for_protrusion(const Workspace& workspace, ShapeWork& work, double limit) {
    const auto keeps_limit = [&](std::size_t count) -> std::optional<bool> { // nothing: the search ended early
        workspace.journal.expect(1);
        compute_until_cut(workspace, work, {count});
        if (!work.known.asked.contains(count)) {
            return {};
        }
        const SphereTree& tree = work.known.trees.at(work.known.asked.at(count));
        return covered_protrusion(work.shape->original(), tree.finest(), workspace.recipe.guarantee) <= limit;
    };
    const std::size_t most = most_of(workspace.recipe, work);
    std::size_t low = work.least, high = work.least;
    std::optional<bool> keeps;
    while ((keeps = keeps_limit(high)) && !*keeps && high < most) {
        low = high + 1;
        high = std::min(2 * high, most);
    }
    if (!keeps) {
        return work.known.asked.rbegin()->second;
    }
    if (!*keeps) {
        workspace.journal.finding({Severity::warning, work.link, work.spherizer.stage,
                                   fmt::format("{} spheres still protrude by more than {} m", most, limit)});
        return work.known.asked.at(most);
    }
    while (low < high) {
        const std::size_t middle = (low + high) / 2;
        keeps = keeps_limit(middle);
        if (!keeps) {
            break;
        }
        (*keeps ? high : low) = *keeps ? middle : middle + 1;
    }
    return work.known.asked.at(high);
}

/// Returns for each shape the count that it takes without an allocation.
ChosenCounts count_each(const Workspace& workspace, std::vector<ShapeWork>& shapes, const std::vector<Group>& groups) {
    std::vector<std::size_t> of_shape(shapes.size(), 0);
    for_each_shape(shapes, [&](std::size_t s) {
        ShapeWork& work = shapes[s];
        if (work.max_protrusion) {
            of_shape[s] = count_for_protrusion(workspace, work, *work.max_protrusion);
            return;
        }
        workspace.journal.expect(1);
        const std::size_t most = fixed_count(workspace.recipe, work);
        if (most < SIZE_MAX && work.adds_spheres && wants_least_excess(workspace.recipe, work)) {
            of_shape[s] = best_of_at_most(workspace, work, most);
            return;
        }
        compute_until_cut(workspace, work, {most == SIZE_MAX ? 0 : most});
        of_shape[s] = work.known.asked.begin()->second;
    });
    ChosenCounts chosen;
    chosen.cut = workspace.cut();
    for (const Group& group : groups) {
        chosen.of_group.push_back(of_shape[group.shape]);
    }
    if (workspace.recipe.budget_spheres && chosen.cut == Cut::none) {
        say_if_not_all(workspace, chosen.of_group.front(), *workspace.recipe.budget_spheres);
    }
    return chosen;
}

void report_cut(const Workspace& workspace, Cut cut) {
    if (cut != Cut::none) {
        workspace.journal.finding(
            {Severity::warning, "", "",
             fmt::format("{}: these are the best spheres so far; another run may give others",
                         cut == Cut::stop
                             ? "the search was stopped"
                             : fmt::format("the search ended at its time limit of {} s", *workspace.time_limit()))});
    }
}

/// Throws Error(recipe) if the budget is below the number of spheres that the groups need at least.
void require_enough(const Recipe& recipe, const std::vector<ShapeWork>& shapes, const std::vector<Group>& groups) {
    std::size_t least = 0;
    for (const Group& group : groups) {
        least += shapes[group.shape].least;
    }
    if (recipe.budget_spheres && *recipe.budget_spheres < least) {
        throw Error(
            ErrorCode::recipe,
            fmt::format(
                "budget.spheres: {} is not enough: the robot's {} {} with geometry to be covered need at least {}; "
                "remedy: raise the budget, or skip links",
                *recipe.budget_spheres, groups.size(), recipe.per_link ? "links" : "elements", least));
    }
}

} // namespace

ChosenCounts choose_counts(const Workspace& preparing, const std::vector<LinkWork>& links,
                           std::vector<ShapeWork>& shapes, const std::vector<Group>& groups, ReferencePose* pose) {
    const Recipe& recipe = preparing.recipe;
    const Workspace workspace = preparing.in(Phase::searching);
    const StopScope scope(workspace.in(Phase::finishing).request()); // a search that ends early keeps its result
    if (recipe.budget_spheres || recipe.budget_excess) {
        require_enough(recipe, shapes, groups);
    }
    const bool shared = (recipe.budget_spheres || recipe.budget_excess) &&
                        (groups.size() != 1 || !has_fixed_count(recipe, shapes.front(), 1));
    ChosenCounts chosen =
        shared ? share_spheres(workspace, links, shapes, groups, pose) : count_each(workspace, shapes, groups);
    report_cut(workspace, chosen.cut);
    return chosen;
}

} // namespace foam::runtime
