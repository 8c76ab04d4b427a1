#include "budget.hpp"

#include "cover.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

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

std::vector<Claim> claims_of(const std::vector<ShapeWork>& shapes, const std::vector<Group>& groups, std::size_t total,
                             bool known_only) {
    std::vector<Claim> claims;
    for (const Group& group : groups) {
        const ShapeWork& work = shapes[group.shape];
        if (!work.error) {
            claims.push_back({&work.curve, work.least, std::min(work.most, total), known_only});
        }
    }
    return claims;
}

/// The count of every group (0 for those with an error) so that the robot has `total` spheres at the least wrong
/// volume. The curves are explored where the allocation goes, until it only rests on known counts.
std::vector<std::size_t> share_spheres(const Workspace& workspace, std::vector<ShapeWork>& shapes,
                                       const std::vector<Group>& groups, std::size_t total) {
    std::vector<std::vector<std::size_t>> wanted(shapes.size());
    for (std::size_t s = 0; s < shapes.size(); ++s) {
        wanted[s] = first_counts(workspace.recipe, shapes[s], groups.size());
    }
    std::vector<std::size_t> counts;
    constexpr int rounds = 8;
    for (int round = 0; round < rounds; ++round) {
        explore(workspace, shapes, wanted);
        const std::vector<Claim> claims = claims_of(shapes, groups, total, false);
        counts = allocate(claims, total);
        if (counts.empty()) {
            break;
        }
        bool settled = true;
        for (auto& list : wanted) {
            list.clear();
        }
        std::size_t c = 0;
        for (const Group& group : groups) {
            ShapeWork& work = shapes[group.shape];
            if (work.error) {
                continue;
            }
            const std::size_t count = counts[c++];
            // The neighbours too: the next round then knows whether one more or less pays.
            for (std::size_t near = std::max(work.least, count - 1); near <= std::min({work.most, total, count + 1});
                 ++near) {
                if (!work.asked.contains(near)) {
                    wanted[group.shape].push_back(near);
                    settled &= near != count;
                }
            }
        }
        if (settled && round > 0) {
            break;
        }
    }
    // Only counts that spherizers delivered, and no more of them than help.
    const std::vector<std::size_t> known = allocate_at_most(claims_of(shapes, groups, total, true), total);
    std::vector<std::size_t> result(groups.size(), 0);
    std::size_t c = 0, sum = 0;
    for (std::size_t g = 0; g < groups.size() && !known.empty(); ++g) {
        if (!shapes[groups[g].shape].error) {
            result[g] = known[c++];
            sum += result[g];
        }
    }
    if (sum > 0 && sum < total) {
        workspace.journal.finding({Severity::warning, "", "",
                                   fmt::format("{} of {} spheres are used: the spherizer has no use for more on these "
                                               "links",
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
    // A first look at small counts and, on large budgets, at multiples of the fair share.
    const std::size_t total = *recipe.budget_spheres;
    const std::size_t fair = std::max<std::size_t>(1, total / std::max<std::size_t>(1, groups));
    std::set<std::size_t> counts;
    for (const std::size_t count :
         {std::size_t{1}, std::size_t{2}, std::size_t{3}, std::size_t{4}, fair, 2 * fair, 4 * fair}) {
        counts.insert(std::clamp(count, shape.least, std::max(shape.least, std::min(shape.most, total))));
    }
    return {counts.begin(), counts.end()};
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
