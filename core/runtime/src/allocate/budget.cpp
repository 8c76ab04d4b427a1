#include "allocate/budget.hpp"

#include <foam/runtime/internal/cover.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>

namespace foam::inline runtime {
namespace {

void say_if_not_all(const Workspace& workspace, const std::vector<ShapeWork>& shapes, std::size_t used) {
    const std::size_t total = *total_of(workspace.recipe);
    if (used == 0 || used >= total) {
        return;
    }
    std::size_t alike = 1; // size of one more element for each of the links that are alike
    for (const ShapeWork& work : shapes) {
        alike = std::max(alike, work.unit * work.groups.size());
    }
    const char* noun = plural_of(shapes);
    const std::string what = workspace.recipe.budget_cost
                                 ? fmt::format("a cost of {:g} of {:g} is used", static_cast<double>(used) * price_step,
                                               *workspace.recipe.budget_cost)
                                 : fmt::format("{} of {} {} are used", used, total, noun);
    if (total - used < alike) {
        workspace.journal.finding(
            {Severity::info, "", "", fmt::format("{}; links that are alike get equal numbers", what)});
        return;
    }
    workspace.journal.finding(
        {Severity::warning, "", "", fmt::format("{}; more {} did not reduce the excess of these links", what, noun)});
}

/// Returns the key of total_of() in `budget`.
const char* word_of_total(const Recipe& recipe) {
    return recipe.budget_cost ? "cost" : recipe.budget_in_elements ? "elements" : "spheres";
}

/// Reports where the allocation differs from the budget.
void report_allocation(const Workspace& workspace, const std::vector<LinkWork>& links,
                       const std::vector<ShapeWork>& shapes, const std::vector<Group>& groups,
                       const std::vector<std::size_t>& counts, double volume, bool enough, Cut cut) {
    const Recipe& recipe = workspace.recipe;
    std::size_t sum = 0, elements = 0;
    double wrong = 0;
    for (const std::size_t g : allocated_groups(shapes, groups)) {
        const ShapeWork& work = shapes[groups[g].shape];
        const Cost cost = work.known.curve.known().at(counts[g]);
        sum += counts[g];
        wrong += cost.volume;
        const SphereTree& tree = work.known.trees.at(counts[g]);
        elements += tree.elements().size();
        const double protrudes = cost.over - std::max(0.0, violation_of(work.clip, tree.elements()));
        if (work.max_protrusion && protrudes > 0) {
            workspace.journal.finding(
                {Severity::warning, links[groups[g].link].link->name, work.spherizer.stage,
                 fmt::format("its {} ({}) protrude by {:.3g} m, max_protrusion allows {:.3g} "
                             "m; remedy: {}",
                             plural_of(shapes), tree.elements().size(), *work.max_protrusion + protrudes,
                             *work.max_protrusion,
                             cut == Cut::none ? fmt::format("more {} for the robot or for this link", plural_of(shapes))
                                              : "more time")});
        }
    }
    if (sum == 0) {
        return;
    }
    if (recipe.budget_excess && !enough) {
        workspace.journal.finding(
            {Severity::warning, "", "",
             fmt::format("budget.excess: {} is not reached: with {} {} it is {:.3g}; remedy: {}",
                         to_text(*recipe.budget_excess), elements, plural_of(shapes), wrong / volume,
                         cut != Cut::none   ? "more time"
                         : total_of(recipe) ? fmt::format("raise budget.{}", word_of_total(recipe))
                                            : "raise max_spheres of the links")});
    } else if (total_of(recipe) && !recipe.budget_excess && cut == Cut::none) {
        say_if_not_all(workspace, shapes, sum);
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

/// Throws Error(recipe) if the cheapest elements that were found cost more than budget.cost: what an element costs, as
/// a hull does by its vertices, is known once it is made.
void require_affordable(const Recipe& recipe, const std::vector<ShapeWork>& shapes, const std::vector<Group>& groups,
                        const ChosenCounts& chosen) {
    if (!recipe.budget_cost) {
        return;
    }
    std::size_t taken = 0, least = 0;
    bool all = true;
    for (const std::size_t g : allocated_groups(shapes, groups)) {
        taken += chosen.of_group[g];
        all = all && chosen.of_group[g] > 0;
        least += shapes[groups[g].shape].known.trees.begin()->first;
    }
    if (!all || taken > *total_of(recipe)) {
        throw Error(ErrorCode::recipe,
                    fmt::format("budget.cost: {:g} is not enough: the cheapest elements found cost at least {:g}; "
                                "remedy: raise the budget, or use cheaper kinds",
                                *recipe.budget_cost, static_cast<double>(least) * price_step));
    }
}

/// Returns the count of every group, 0 for those with an error. With a number of spheres as budget: at most that many,
/// with the least weighted cost. With an excess as budget: the fewest that keep it.
ChosenCounts share_spheres(const Workspace& workspace, const std::vector<LinkWork>& links,
                           std::vector<ShapeWork>& shapes, const std::vector<Group>& groups, ReferencePose* pose,
                           RandomPoses* poses) {
    const Recipe& recipe = workspace.recipe;
    Goal goal;
    goal.most = total_of(recipe).value_or(SIZE_MAX);
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
    if (poses && !shared.counts.empty() && chosen.cut == Cut::none) {
        shared = with_fewer_false_contacts(workspace, shapes, groups, goal, *poses, std::move(shared), chosen.cut);
    }
    chosen.of_group.assign(groups.size(), 0);
    const std::vector<std::size_t> allocated_groups = foam::allocated_groups(shapes, groups);
    for (std::size_t i = 0; i < shared.counts.size(); ++i) {
        chosen.of_group[allocated_groups[i]] = shared.counts[i];
    }
    require_affordable(recipe, shapes, groups, chosen);
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
        return protrusion_of_elements(work.shape->original(), tree.elements(), workspace.recipe.guarantee) <= limit;
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
                                   fmt::format("{} {} still protrude by more than {} m", most,
                                               spheres_alone(work.kinds) ? "spheres" : "elements", limit)});
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
    require_affordable(workspace.recipe, shapes, groups, chosen);
    if (total_of(workspace.recipe) && chosen.cut == Cut::none) {
        say_if_not_all(workspace, shapes, chosen.of_group.front());
    }
    return chosen;
}

void report_cut(const Workspace& workspace, Cut cut) {
    if (cut != Cut::none) {
        workspace.journal.finding(
            {Severity::warning, "", "",
             fmt::format("{}: these are the best elements so far; another run may give others",
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
    if (const std::optional<std::size_t> total = total_of(recipe); total && *total < least) {
        const auto text = [&](std::size_t size) {
            return recipe.budget_cost ? fmt::format("{:g}", static_cast<double>(size) * price_step)
                                      : fmt::format("{}", size);
        };
        throw Error(
            ErrorCode::recipe,
            fmt::format("budget.{}: {} is not enough: the robot's {} {} with geometry to be covered need at least {}; "
                        "remedy: raise the budget, or skip links",
                        word_of_total(recipe), text(*total), groups.size(), recipe.per_link ? "links" : "elements",
                        text(least)));
    }
}

} // namespace

ChosenCounts choose_counts(const Workspace& preparing, const std::vector<LinkWork>& links,
                           std::vector<ShapeWork>& shapes, const std::vector<Group>& groups, ReferencePose* pose,
                           RandomPoses* poses) {
    const Recipe& recipe = preparing.recipe;
    const Workspace workspace = preparing.in(Phase::searching);
    const StopScope scope(workspace.in(Phase::finishing).request()); // a search that ends early keeps its result
    if (total_of(recipe) || recipe.budget_excess) {
        require_enough(recipe, shapes, groups);
    }
    const bool shared = (total_of(recipe) || recipe.budget_excess) &&
                        (groups.size() != 1 || !has_fixed_count(recipe, shapes.front(), 1));
    ChosenCounts chosen =
        shared ? share_spheres(workspace, links, shapes, groups, pose, poses) : count_each(workspace, shapes, groups);
    report_cut(workspace, chosen.cut);
    return chosen;
}

} // namespace foam::inline runtime
