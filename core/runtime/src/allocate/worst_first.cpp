#include "allocate/budget.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace foam::inline runtime {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Returns the fewest spheres of a shape whose figure is at most `limit`; 0 if no known count is enough.
std::size_t fewest_within(const std::map<std::size_t, double>& figures, double limit) {
    const auto good = std::find_if(figures.begin(), figures.end(), [&](const auto& f) { return f.second <= limit; });
    return good == figures.end() ? 0 : good->first;
}

/// Returns for each group the fewest spheres within the limit; empty if a group has no such known count, or the sum is
/// above `most`.
std::vector<std::size_t> counts_within(const std::vector<std::size_t>& shape_of_taker, const Figures& figures,
                                       double limit, std::size_t most) {
    std::vector<std::size_t> counts;
    std::size_t sum = 0;
    for (const std::size_t shape : shape_of_taker) {
        counts.push_back(fewest_within(figures[shape], limit));
        sum += counts.back();
        if (counts.back() == 0 || sum > most) {
            return {};
        }
    }
    return counts;
}

std::vector<std::size_t> shapes_of(const std::vector<std::size_t>& allocated_groups, const std::vector<Group>& groups) {
    std::vector<std::size_t> shapes;
    for (const std::size_t g : allocated_groups) {
        shapes.push_back(groups[g].shape);
    }
    return shapes;
}

/// Returns the least limit that all groups can keep with `most` spheres together; infinite if there are not enough.
double best_worst(const std::vector<std::size_t>& shape_of_taker, const Figures& figures, std::size_t most) {
    std::vector<double> limits;
    for (const std::size_t shape : shape_of_taker) {
        for (const auto& [count, figure] : figures[shape]) {
            limits.push_back(figure);
        }
    }
    std::sort(limits.begin(), limits.end());
    const auto best = std::partition_point(limits.begin(), limits.end(), [&](double limit) {
        return counts_within(shape_of_taker, figures, limit, most).empty();
    });
    return best == limits.end() ? infinity : *best;
}

} // namespace

std::optional<Objective> common_objective(const Recipe& recipe, const std::vector<ShapeWork>& shapes) {
    for (const ShapeWork& work : shapes) {
        if (recipe.guarantee != Guarantee::outer || work.max_protrusion || !work.objective ||
            work.objective == Objective::excess || work.objective != shapes.front().objective) {
            return {};
        }
    }
    return shapes.empty() ? std::nullopt : shapes.front().objective;
}

Cut explore_worst_first(const Workspace& workspace, std::vector<ShapeWork>& shapes, const std::vector<Group>& groups,
                        Objective objective, std::size_t most, Figures& figures) {
    figures.assign(shapes.size(), {});
    std::vector<std::vector<std::size_t>> wanted(shapes.size());
    for (std::size_t s = 0; s < shapes.size(); ++s) {
        wanted[s] = first_counts(workspace.recipe, shapes[s], groups.size());
    }
    Cut cut = Cut::none;
    for (bool any = true; any && cut == Cut::none;) {
        cut = explore(workspace, shapes, wanted);
        measure_trees(
            workspace, shapes,
            [&](std::size_t s, std::size_t count) {
                return figures[s].contains(count) || !shapes[s].known.curve.knows(count);
            },
            [&](std::size_t s) { return figures[s].empty(); },
            [&](const ShapeWork& work, const SphereTree& tree) {
                return figure_of(work.shape->original(), tree.elements(), objective);
            },
            [&](std::size_t s, std::size_t count, double figure) { figures[s][count] = figure; });
        const std::vector<std::size_t> of_allocated = shapes_of(allocated_groups(shapes, groups), groups);
        const double limit = best_worst(of_allocated, figures, most);
        // Explore the shapes that determine the limit: those with no better known figure.
        any = false;
        for (std::size_t s = 0; s < shapes.size(); ++s) {
            wanted[s].clear();
            const ShapeWork& work = shapes[s];
            if (work.error || figures[s].empty() || figures[s].rbegin()->second < limit) {
                continue;
            }
            const std::size_t explored = work.known.asked.rbegin()->first;
            if (explored < most) {
                wanted[s] = rungs_above(work, explored, most_of(workspace.recipe, work));
                any = any || !wanted[s].empty();
            }
        }
    }
    return cut;
}

std::vector<Bounds> bounds_of_best_worst(const std::vector<ShapeWork>& shapes, const std::vector<Group>& groups,
                                         const Figures& figures, std::size_t most) {
    const std::vector<std::size_t> of_allocated = shapes_of(allocated_groups(shapes, groups), groups);
    std::vector<Bounds> bounds;
    for (const std::size_t count :
         counts_within(of_allocated, figures, best_worst(of_allocated, figures, most), most)) {
        bounds.push_back({count, SIZE_MAX});
    }
    return bounds;
}

} // namespace foam::runtime
