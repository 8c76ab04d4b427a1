// Getting to know what spheres cost each shape, as far as that decides who gets how many.
#pragma once

#include "shapes.hpp"

#include <algorithm>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace foam {

/// What spheres are shared for.
struct Goal {
    std::size_t most = SIZE_MAX;  ///< spheres
    std::optional<double> enough; ///< m³; the wrong volume that is good enough
};

/// The groups of which the shape has no error.
std::vector<std::size_t> takers(const std::vector<ShapeWork>& shapes, const std::vector<Group>& groups);

/// The most spheres that a shape may have: where neither budget nor link says, 256.
std::size_t most_of(const Recipe& recipe, const ShapeWork& work);

/// A shape whose spheres are shared with no other and limited by their number only. `groups`: of the robot.
bool has_number_of_its_own(const Recipe& recipe, const ShapeWork& shape, std::size_t groups);

/// Of such a shape; SIZE_MAX: as many as the spherizer's own parameters make.
std::size_t number_of_its_own(const Recipe& recipe, const ShapeWork& shape);

/// The counts that choose_counts() asks of a shape before it knows anything; 0: no budget. `groups`: of the robot.
std::vector<std::size_t> first_counts(const Recipe& recipe, const ShapeWork& shape, std::size_t groups);

/// compute_trees(); of a search that is cut, those until then. If there is none yet, a stop cancels the run, and after
/// a time limit it is the tree of the fewest spheres, or one ball around the shape where that takes too long as well.
void compute_until_cut(const Workspace& workspace, ShapeWork& work, const std::vector<std::size_t>& counts);

/// Of a number of spheres.
struct Bounds {
    std::size_t least = 0, most = SIZE_MAX;
};

/// What is known of counts within the bounds.
CostCurve within(const CostCurve& curve, const Bounds& bounds);

/// Counts for the takers from what their curves know, and whether they are enough for the goal. Empty if there are not
/// enough spheres for all.
struct Shared {
    std::vector<std::size_t> counts;
    bool enough = false;
};
/// `bounds`: of each taker; empty: none.
Shared share(const std::vector<ShapeWork>& shapes, const std::vector<Group>& groups, const Goal& goal,
             const std::vector<Bounds>& bounds = {});

/// What `measure()` gives, under the request of a phase; nothing if that ended it.
template <class Measure> auto measured_in(const Workspace& workspace, Measure measure) {
    std::optional<std::invoke_result_t<Measure&>> result;
    try {
        const StopScope scope(workspace.request());
        check_cancelled();
        result.emplace(measure());
    } catch (const Error& error) {
        if (error.code() != ErrorCode::cancelled) {
            throw;
        }
    }
    return result;
}

/// Measures trees on all cores, those of a search that was cut, too, as far as there is time: they are of no use
/// without. Of the shapes without an error, each tree of which `known(shape, count)` is false; `keep(shape, count,
/// measured)` is called in their order with what `measure(work, tree)` gave. Where `nothing_known(shape)`, the first
/// is measured whatever time that takes. Returns whether there was time for all.
template <class Known, class NothingKnown, class Measure, class Keep>
bool measure_trees(const Workspace& workspace, const std::vector<ShapeWork>& shapes, Known known,
                   NothingKnown nothing_known, Measure measure, Keep keep) {
    struct Point {
        std::size_t shape, count;
        bool needed;
        std::optional<std::invoke_result_t<Measure&, const ShapeWork&, const SphereTree&>> measured{};
    };
    std::vector<Point> points;
    for (std::size_t s = 0; s < shapes.size(); ++s) {
        bool needed = nothing_known(s);
        for (const auto& [count, tree] : shapes[s].known.trees) {
            if (!shapes[s].error && !known(s, count)) {
                points.push_back({s, count, needed});
                needed = false;
            }
        }
    }
    std::stable_partition(points.begin(), points.end(), [](const Point& point) { return point.needed; });
    parallel_for(points.size(), [&](std::size_t i) {
        Point& point = points[i];
        const ShapeWork& work = shapes[point.shape];
        const auto once = [&] { return measure(work, work.known.trees.at(point.count)); };
        if (point.needed) {
            point.measured = once();
        } else {
            point.measured = measured_in(workspace.in(Phase::beginning), once);
        }
    });
    std::stable_sort(points.begin(), points.end(), [](const Point& a, const Point& b) {
        return std::pair(a.shape, a.count) < std::pair(b.shape, b.count);
    });
    bool all = true;
    for (const Point& point : points) {
        if (point.measured) {
            keep(point.shape, point.count, *point.measured);
        }
        all = all && point.measured;
    }
    return all;
}

/// Makes the curves know the counts asked for: spherize, cover, measure what is claimed wrongly. What cut the search
/// meanwhile is returned; something is known of every shape then, too.
Cut explore(const Workspace& workspace, std::vector<ShapeWork>& shapes,
            const std::vector<std::vector<std::size_t>>& counts);

/// Makes the curves known as far as the goal takes. What cut it before its time is returned; something is known of
/// every shape without an error then, too.
Cut explore_for(const Workspace& workspace, std::vector<ShapeWork>& shapes, const std::vector<Group>& groups,
                const Goal& goal);

} // namespace foam
