#include "budget.hpp"

#include "cover.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace foam {
namespace {

/// Largest number of spheres of a link where neither budget nor link says.
constexpr std::size_t most_unasked = 256;

std::size_t most_of(const Recipe& recipe, const ShapeWork& work) {
    return work.most == SIZE_MAX && !recipe.budget_spheres ? std::max(work.least, most_unasked) : work.most;
}

/// What a tree of a shape costs once the guarantee is kept.
Cost cost_of(const Workspace& workspace, const ShapeWork& work, const SphereTree& tree) {
    const Solid& solid = work.shape->original();
    const Guarantee guarantee = workspace.recipe.guarantee;
    Cost cost;
    cost.volume = wrong_volume(solid, tree.finest(), guarantee);
    if (work.max_protrusion) {
        cost.over = std::max(0.0, covered_protrusion(solid, tree.finest(), guarantee) - *work.max_protrusion);
    }
    return cost;
}

/// Makes the curves know the counts asked for: spherize, cover, measure what is claimed wrongly.
void explore(const Workspace& workspace, std::vector<ShapeWork>& shapes,
             const std::vector<std::vector<std::size_t>>& counts) {
    for (std::size_t s = 0; s < shapes.size(); ++s) {
        workspace.journal.expect(counts[s].empty() ? 0 : 1);
    }
    for_each_shape(shapes, [&](std::size_t s) { compute_trees(workspace, shapes[s], counts[s]); });
    struct Point {
        std::size_t shape, count;
        Cost cost;
    };
    std::vector<Point> points;
    for (std::size_t s = 0; s < shapes.size(); ++s) {
        for (const auto& [count, tree] : shapes[s].trees) {
            if (!shapes[s].error && !shapes[s].curve.knows(count)) {
                points.push_back({s, count, {}});
            }
        }
    }
    parallel_for(points.size(), [&](std::size_t i) {
        workspace.check_cancelled();
        const ShapeWork& work = shapes[points[i].shape];
        points[i].cost = cost_of(workspace, work, work.trees.at(points[i].count));
    });
    for (const Point& point : points) {
        shapes[point.shape].curve.set(point.count, point.cost);
    }
}

/// The groups of which the shape has no error.
std::vector<std::size_t> takers(const std::vector<ShapeWork>& shapes, const std::vector<Group>& groups) {
    std::vector<std::size_t> takers;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        if (!shapes[groups[g].shape].error) {
            takers.push_back(g);
        }
    }
    return takers;
}

/// What the spheres are shared for.
struct Goal {
    std::size_t most = SIZE_MAX;  ///< spheres
    std::optional<double> enough; ///< m³; the wrong volume that is good enough
};

/// Shares out what is known: empty if the groups need more than there are. `reached`: not more would be enough.
std::vector<std::size_t> share(const std::vector<ShapeWork>& shapes, const std::vector<Group>& groups, const Goal& goal,
                               bool& reached) {
    std::vector<Claimant> claimants;
    for (const std::size_t g : takers(shapes, groups)) {
        claimants.push_back({&shapes[groups[g].shape].curve, groups[g].weight});
    }
    const Sharing sharing(claimants, goal.most);
    if (goal.enough) {
        if (std::vector<std::size_t> counts = sharing.fewest(*goal.enough); !counts.empty()) {
            reached = true;
            return counts;
        }
    }
    reached = false;
    return sharing.best();
}

/// What a sphere more than were explored may save, m³: costs were seen to fall as count^-0.4 on links of robots.
double expected_gain(const Recipe& recipe, const ShapeWork& work) {
    return work.asked.rbegin()->first < most_of(recipe, work)
               ? 0.4 * work.curve.least().volume / static_cast<double>(work.asked.rbegin()->first)
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

    /// Explores the curves, those first that do not keep their limit yet, then always where a sphere more may save
    /// most, until at the price of what it may save there the shapes would take as many as there are, or as are enough.
    /// The order does not depend on the target, only its end does: more spheres to share mean that the same is known
    /// and perhaps more, and the best sharing is never worse.
    void run() {
        std::vector<std::vector<std::size_t>> wanted(shapes_.size());
        for (std::size_t s = 0; s < shapes_.size(); ++s) {
            wanted[s] = first_counts(workspace_.recipe, shapes_[s], groups_.size());
        }
        do {
            explore(workspace_, shapes_, wanted);
            wanted = rungs_over_limit();
            if (wanted.empty()) {
                wanted = rungs_that_save();
            }
        } while (!wanted.empty());
    }

private:
    double gain(std::size_t s) const { return weights_[s] * expected_gain(workspace_.recipe, shapes_[s]); }

    std::vector<std::size_t> rungs(std::size_t s) const {
        return next_rungs(shapes_[s].asked.rbegin()->first, shapes_[s].least, most_of(workspace_.recipe, shapes_[s]));
    }

    /// Of the shapes of which no count is known that keeps the limit. Empty: none of them could have more spheres.
    std::vector<std::vector<std::size_t>> rungs_over_limit() const {
        std::vector<std::vector<std::size_t>> wanted(shapes_.size());
        bool any = false;
        for (std::size_t s = 0; s < shapes_.size(); ++s) {
            const ShapeWork& work = shapes_[s];
            // With the least number for each of the others.
            if (!work.error && work.curve.least().over > 0 &&
                least_ - work.least + work.asked.rbegin()->first < goal_.most) {
                wanted[s] = rungs(s);
                any = any || !wanted[s].empty();
            }
        }
        return any ? wanted : std::vector<std::vector<std::size_t>>{};
    }

    /// Of the shapes of which a sphere may save most, or nearly as much, to use all cores. Empty: that is enough.
    std::vector<std::vector<std::size_t>> rungs_that_save() const {
        const std::vector<std::size_t> takers = foam::takers(shapes_, groups_);
        double price = 0;
        std::size_t explored = 0; // of the shape that may save most
        for (const std::size_t g : takers) {
            if (const double saved = gain(groups_[g].shape); saved > price) {
                price = saved;
                explored = shapes_[groups_[g].shape].asked.rbegin()->first;
            }
        }
        std::size_t demand = 0;
        for (const std::size_t g : takers) {
            demand += shapes_[groups_[g].shape].curve.demand(price, groups_[g].weight);
        }
        const std::size_t total = total_wanted();
        if (price == 0 || demand >= total || explored >= total) {
            return {};
        }
        constexpr double nearly = 0.5;
        std::vector<std::vector<std::size_t>> wanted(shapes_.size());
        for (std::size_t s = 0; s < shapes_.size(); ++s) {
            if (!shapes_[s].error && gain(s) >= nearly * price) {
                wanted[s] = rungs(s);
            }
        }
        return wanted;
    }

    std::size_t total_wanted() const {
        bool reached = false;
        std::size_t sum = 0;
        if (goal_.enough) {
            for (const std::size_t count : share(shapes_, groups_, goal_, reached)) {
                sum += count;
            }
        }
        return reached ? sum : goal_.most;
    }

    const Workspace& workspace_;
    std::vector<ShapeWork>& shapes_;
    const std::vector<Group>& groups_;
    const Goal& goal_;
    std::vector<double> weights_; ///< of each shape, the largest of its groups
    std::size_t least_ = 0;       ///< spheres that all groups need
};

/// One group: nothing to share. The fewest that are enough lie between two rungs: bisected.
void narrow_down(const Workspace& workspace, std::vector<ShapeWork>& shapes, const std::vector<Group>& groups,
                 const Goal& goal) {
    ShapeWork& work = shapes.front();
    bool reached = false;
    if (!goal.enough || work.error || share(shapes, groups, goal, reached).empty() || !reached) {
        return;
    }
    const auto enough = [&](const Cost& cost) {
        return cost.over <= work.curve.least().over && cost.volume <= *goal.enough;
    };
    while (true) {
        std::size_t low = 0, high = 0; // the fewest asked for that are enough, and the most before them
        for (const auto& [asked, got] : work.asked) {
            if (enough(work.curve.known().at(got))) {
                high = asked;
                break;
            }
            low = asked;
        }
        if (high <= low + 1 || high <= work.least) {
            return;
        }
        explore(workspace, shapes, {{(low + high) / 2}});
    }
}

/// What the robot is told of a sharing that is not what was asked for.
void report_sharing(const Workspace& workspace, const std::vector<LinkWork>& links,
                    const std::vector<ShapeWork>& shapes, const std::vector<Group>& groups,
                    const std::vector<std::size_t>& counts, double volume, bool reached) {
    const Recipe& recipe = workspace.recipe;
    std::size_t sum = 0;
    double wrong = 0;
    for (const std::size_t g : takers(shapes, groups)) {
        const ShapeWork& work = shapes[groups[g].shape];
        const Cost cost = work.curve.known().at(counts[g]);
        sum += counts[g];
        wrong += cost.volume;
        if (cost.over > 0) {
            workspace.journal.finding(
                {Severity::warning, links[groups[g].link].link->name, work.spherizer.stage,
                 fmt::format("its spheres ({}) protrude by {:.3g} m, max_protrusion allows {:.3g} "
                             "m; remedy: more spheres for the robot or for this link",
                             counts[g], *work.max_protrusion + cost.over, *work.max_protrusion)});
        }
    }
    if (sum == 0) {
        return;
    }
    if (recipe.budget_excess && !reached) {
        workspace.journal.finding(
            {Severity::warning, "", "",
             fmt::format("budget.excess: {} is not reached: with {} spheres it is {:.3g}; remedy: {}",
                         to_text(*recipe.budget_excess), sum, wrong / volume,
                         recipe.budget_spheres ? "raise budget.spheres" : "raise max_spheres of the links")});
    } else if (recipe.budget_spheres && !recipe.budget_excess && sum < *recipe.budget_spheres) {
        workspace.journal.finding(
            {Severity::warning, "", "",
             fmt::format("{} of {} spheres are used: more that the spherizer tried on these links "
                         "would not lower the excess",
                         sum, *recipe.budget_spheres)});
    }
}

/// Volume of the groups' geometry, m³.
double volume_of(const std::vector<ShapeWork>& shapes, const std::vector<Group>& groups) {
    double volume = 0;
    for (const std::size_t g : takers(shapes, groups)) {
        volume += shapes[groups[g].shape].shape->original().volume();
    }
    return volume;
}

/// The count of every group (0 for those with an error): at most as many spheres as the budget has, at the least wrong
/// volume; or the fewest that are enough.
std::vector<std::size_t> share_spheres(const Workspace& workspace, const std::vector<LinkWork>& links,
                                       std::vector<ShapeWork>& shapes, const std::vector<Group>& groups) {
    const Recipe& recipe = workspace.recipe;
    Goal goal;
    goal.most = recipe.budget_spheres.value_or(SIZE_MAX);
    const double volume = volume_of(shapes, groups);
    if (recipe.budget_excess) {
        if (volume == 0) {
            throw Error(ErrorCode::recipe, "budget.excess: the geometry has no volume to compare with; remedy: budget: "
                                           "{spheres: …} or {max_protrusion: …}");
        }
        goal.enough = *recipe.budget_excess * volume;
    }
    if (groups.size() == 1) {
        shapes.front().most = std::min(shapes.front().most, goal.most);
    }
    if (groups.size() == 1 && !recipe.budget_excess) { // nothing to share
        explore(workspace, shapes, {first_counts(recipe, shapes.front(), 1)});
    } else {
        Exploration(workspace, shapes, groups, goal).run();
    }
    if (groups.size() == 1) {
        narrow_down(workspace, shapes, groups, goal);
    }
    bool reached = false;
    const std::vector<std::size_t> shared = share(shapes, groups, goal, reached);
    std::vector<std::size_t> result(groups.size(), 0);
    const std::vector<std::size_t> takers = foam::takers(shapes, groups);
    for (std::size_t i = 0; i < shared.size(); ++i) {
        result[takers[i]] = shared[i];
    }
    report_sharing(workspace, links, shapes, groups, result, volume, reached);
    return result;
}

/// The fewest spheres whose cover protrudes by no more than the limit: doubled until it holds, then bisected.
std::size_t count_for_protrusion(const Workspace& workspace, ShapeWork& work, double limit) {
    const auto protrusion = [&](std::size_t count) {
        workspace.journal.expect(1);
        compute_trees(workspace, work, {count});
        return covered_protrusion(work.shape->original(), work.trees.at(work.asked.at(count)).finest(),
                                  workspace.recipe.guarantee);
    };
    const std::size_t most = most_of(workspace.recipe, work);
    std::size_t low = work.least, high = work.least;
    while (protrusion(high) > limit) {
        if (high == most) {
            workspace.journal.finding({Severity::warning, work.link, work.spherizer.stage,
                                       fmt::format("{} spheres still protrude by more than {} m", most, limit)});
            return work.asked.at(most);
        }
        low = high + 1;
        high = std::min(2 * high, most);
    }
    while (low < high) {
        const std::size_t middle = (low + high) / 2;
        if (protrusion(middle) > limit) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    protrusion(high);
    return work.asked.at(high);
}

/// Throws for a budget below the least that the groups need.
void require_enough(const Recipe& recipe, const std::vector<ShapeWork>& shapes, const std::vector<Group>& groups) {
    std::size_t least = 0;
    for (const Group& group : groups) {
        least += shapes[group.shape].least;
    }
    if (recipe.budget_spheres && *recipe.budget_spheres < least) {
        throw Error(
            ErrorCode::recipe,
            fmt::format("budget.spheres: {} is not enough: the robot's {} {} with collision geometry need at least {}; "
                        "remedy: raise the budget, or skip links",
                        *recipe.budget_spheres, groups.size(), recipe.per_link ? "links" : "elements", least));
    }
}

} // namespace

std::vector<std::size_t> first_counts(const Recipe& recipe, const ShapeWork& shape, std::size_t groups) {
    if (!recipe.budget_spheres && !recipe.budget_excess) {
        return {shape.max_protrusion ? shape.least : shape.most == SIZE_MAX ? 0 : shape.most};
    }
    std::vector<std::size_t> counts = next_rungs(0, shape.least, most_of(recipe, shape));
    if (groups == 1 && recipe.budget_spheres) { // nothing to share: all of them, or fewer where more claim more
        std::erase_if(counts, [&](std::size_t count) { return count > *recipe.budget_spheres; });
        if (const std::size_t all = std::min(*recipe.budget_spheres, shape.most);
            !recipe.budget_excess && (counts.empty() || counts.back() < all)) {
            counts.push_back(all);
        }
    }
    return counts;
}

std::vector<std::size_t> choose_counts(const Workspace& workspace, const std::vector<LinkWork>& links,
                                       std::vector<ShapeWork>& shapes, const std::vector<Group>& groups) {
    const Recipe& recipe = workspace.recipe;
    if (recipe.budget_spheres || recipe.budget_excess) {
        require_enough(recipe, shapes, groups);
        return share_spheres(workspace, links, shapes, groups);
    }
    std::vector<std::size_t> of_shape(shapes.size(), 0);
    for_each_shape(shapes, [&](std::size_t s) {
        ShapeWork& work = shapes[s];
        if (work.max_protrusion) {
            of_shape[s] = count_for_protrusion(workspace, work, *work.max_protrusion);
            return;
        }
        workspace.journal.expect(1);
        const std::size_t asked = first_counts(recipe, work, groups.size()).front();
        compute_trees(workspace, work, {asked});
        of_shape[s] = work.asked.at(asked);
    });
    std::vector<std::size_t> counts(groups.size(), 0);
    for (std::size_t g = 0; g < groups.size(); ++g) {
        counts[g] = of_shape[groups[g].shape];
    }
    return counts;
}

} // namespace foam
