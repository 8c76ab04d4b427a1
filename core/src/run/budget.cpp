#include "budget.hpp"

#include "cover.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace foam {
namespace {

/// Largest number of spheres that a link gets from a robot-wide protrusion budget.
constexpr std::size_t protrusion_limit = 256;

/// Makes the curves know the counts asked for: spherize, cover, measure what is claimed wrongly.
void explore(const Workspace& workspace, std::vector<ShapeWork>& shapes,
             const std::vector<std::vector<std::size_t>>& counts) {
    for (std::size_t s = 0; s < shapes.size(); ++s) {
        workspace.journal.expect(counts[s].empty() ? 0 : 1);
    }
    for_each_shape(shapes, [&](std::size_t s) { compute_trees(workspace, shapes[s], counts[s]); });
    struct Point {
        std::size_t shape, count;
        double cost;
    };
    std::vector<Point> points;
    for (std::size_t s = 0; s < shapes.size(); ++s) {
        for (const auto& [count, tree] : shapes[s].trees) {
            if (!shapes[s].error && !shapes[s].curve.knows(count)) {
                points.push_back({s, count, 0});
            }
        }
    }
    parallel_for(points.size(), [&](std::size_t i) {
        workspace.check_cancelled();
        const ShapeWork& work = shapes[points[i].shape];
        points[i].cost =
            wrong_volume(work.shape->original(), work.trees.at(points[i].count).finest(), workspace.recipe.guarantee);
    });
    for (const Point& point : points) {
        shapes[point.shape].curve.set(point.count, point.cost);
    }
}

/// The shapes of the groups that have no error, one a group.
std::vector<const ShapeWork*> takers(const std::vector<ShapeWork>& shapes, const std::vector<Group>& groups) {
    std::vector<const ShapeWork*> works;
    for (const Group& group : groups) {
        if (!shapes[group.shape].error) {
            works.push_back(&shapes[group.shape]);
        }
    }
    return works;
}

/// What a sphere more than were explored may save, m³: costs were seen to fall as count^-0.4 on links of robots.
double expected_gain(const ShapeWork& work) {
    return work.asked.rbegin()->first < work.most
               ? 0.4 * work.curve.least() / static_cast<double>(work.asked.rbegin()->first)
               : 0;
}

/// Explores the curves, always where a sphere more may save most, until at the price of what it may save there the
/// shapes would take as many as there are. The order does not depend on `total`, only its end does: more spheres to
/// share mean that the same is known and perhaps more, and the best sharing is never worse.
void explore_curves(const Workspace& workspace, std::vector<ShapeWork>& shapes, const std::vector<Group>& groups,
                    std::size_t total) {
    std::vector<std::vector<std::size_t>> wanted(shapes.size());
    for (std::size_t s = 0; s < shapes.size(); ++s) {
        wanted[s] = first_counts(workspace.recipe, shapes[s], groups.size());
    }
    while (true) {
        explore(workspace, shapes, wanted);
        const std::vector<const ShapeWork*> works = takers(shapes, groups);
        double price = 0;
        std::size_t explored = 0; // of the shape that may save most
        for (const ShapeWork* work : works) {
            if (const double gain = expected_gain(*work); gain > price) {
                price = gain;
                explored = work->asked.rbegin()->first;
            }
        }
        std::size_t demand = 0;
        for (const ShapeWork* work : works) {
            demand += work->curve.demand(price);
        }
        if (price == 0 || demand >= total || explored >= total || groups.size() == 1) {
            return;
        }
        // Those that may save nearly as much at once, to use all cores.
        constexpr double nearly = 0.5;
        for (std::size_t s = 0; s < shapes.size(); ++s) {
            wanted[s].clear();
            if (!shapes[s].error && expected_gain(shapes[s]) >= nearly * price) {
                wanted[s] = next_rungs(shapes[s].asked.rbegin()->first, shapes[s].least, shapes[s].most);
            }
        }
    }
}

/// The count of every group (0 for those with an error) so that the robot has at most `total` spheres at the least
/// wrong volume.
std::vector<std::size_t> share_spheres(const Workspace& workspace, std::vector<ShapeWork>& shapes,
                                       const std::vector<Group>& groups, std::size_t total) {
    explore_curves(workspace, shapes, groups, total);
    std::vector<const CostCurve*> curves;
    for (const ShapeWork* work : takers(shapes, groups)) {
        curves.push_back(&work->curve);
    }
    const std::vector<std::size_t> shared = allocate_at_most(curves, total);
    std::vector<std::size_t> result(groups.size(), 0);
    std::size_t c = 0, sum = 0;
    for (std::size_t g = 0; g < groups.size() && !shared.empty(); ++g) {
        if (!shapes[groups[g].shape].error) {
            result[g] = shared[c++];
            sum += result[g];
        }
    }
    if (sum > 0 && sum < total) {
        workspace.journal.finding(
            {Severity::warning, "", "",
             fmt::format("{} of {} spheres are used: more that the spherizer tried on these links "
                         "would not lower the excess",
                         sum, total)});
    }
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
    const std::size_t most = std::min(work.most, std::max(work.least, protrusion_limit));
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

} // namespace

std::vector<std::size_t> first_counts(const Recipe& recipe, const ShapeWork& shape, std::size_t groups) {
    if (!recipe.budget_spheres) {
        return {recipe.budget_max_protrusion ? shape.least : shape.most == SIZE_MAX ? 0 : shape.most};
    }
    std::vector<std::size_t> counts = next_rungs(0, shape.least, shape.most);
    if (groups == 1) { // nothing to share: all of them, or fewer where more claim more
        std::erase_if(counts, [&](std::size_t count) { return count > *recipe.budget_spheres; });
        if (const std::size_t all = std::min(*recipe.budget_spheres, shape.most);
            counts.empty() || counts.back() < all) {
            counts.push_back(all);
        }
    }
    return counts;
}

std::vector<std::size_t> choose_counts(const Workspace& workspace, std::vector<ShapeWork>& shapes,
                                       const std::vector<Group>& groups) {
    const Recipe& recipe = workspace.recipe;
    if (recipe.budget_spheres) {
        std::size_t least = 0;
        for (const Group& group : groups) {
            least += shapes[group.shape].least;
        }
        if (*recipe.budget_spheres < least) {
            throw Error(
                ErrorCode::recipe,
                fmt::format(
                    "budget.spheres: {} is not enough: the robot's {} {} with collision geometry need at least {}; "
                    "remedy: raise the budget, or skip links",
                    *recipe.budget_spheres, groups.size(), recipe.per_link ? "links" : "elements", least));
        }
        return share_spheres(workspace, shapes, groups, *recipe.budget_spheres);
    }
    std::vector<std::size_t> of_shape(shapes.size(), 0);
    for_each_shape(shapes, [&](std::size_t s) {
        ShapeWork& work = shapes[s];
        if (recipe.budget_max_protrusion) {
            of_shape[s] = count_for_protrusion(workspace, work, *recipe.budget_max_protrusion);
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
