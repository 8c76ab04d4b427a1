// Exploration of the costs of each shape, as far as the allocation depends on them.
#pragma once

#include "input/shapes.hpp"

#include <algorithm>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace foam::inline runtime {

/// Makes the refiners of a shape, whose geometry is built.
void begin_refinements(const Workspace& workspace, ShapeWork& work);

/// Returns the tree after all refinements, or after those that do not add spheres, with at most `most` spheres in the
/// finest level. Checks the result of each. Several threads may call it for one shape. After a request to stop, the
/// result so far is returned.
enum class Refiners { all, not_adding };
SphereTree refined(const Workspace& workspace, ShapeWork& work, SphereTree tree, std::size_t most, Refiners which);

/// Checks the contract of spherizers and refiners: finite spheres, valid elements of the kinds that the stage declares,
/// in proportion to the shape with these bounds, at most as many as requested and as cost what was requested, valid
/// parents. Throws Error(plugin).
void check_tree(const SphereTree& tree, const Budget& budget, const std::vector<Element::Kind>& kinds,
                const Box& bounds, std::string_view stage_kind);

/// Returns the cache key of a shape's tree with at most `count` spheres; 0: no budget.
Digest tree_key(const Workspace& workspace, const ShapeWork& work, std::size_t count);

/// Adds the trees for the requested counts, from the cache or the stage, and checks the results of the stage. Count 0
/// means "no budget".
void compute_trees(const Workspace& workspace, ShapeWork& work, const std::vector<std::size_t>& counts);

/// The goal of an allocation.
struct Goal {
    std::size_t most = SIZE_MAX;  ///< number of elements, or cost: see total_of()
    std::optional<double> enough; ///< m³; an excess volume that is good enough
};

/// Returns the groups whose shape has no error.
std::vector<std::size_t> allocated_groups(const std::vector<ShapeWork>& shapes, const std::vector<Group>& groups);

/// Returns the most spheres that a shape may have: 256 if neither budget nor link gives a number.
std::size_t most_of(const Recipe& recipe, const ShapeWork& work);

/// Returns whether a shape has a fixed count: it takes part in no allocation, and only its number of spheres is
/// limited. `groups`: number of groups of the robot.
bool has_fixed_count(const Recipe& recipe, const ShapeWork& shape, std::size_t groups);

/// Returns the fixed count of such a shape; SIZE_MAX: as many as the spherizer makes by its own parameters.
std::size_t fixed_count(const Recipe& recipe, const ShapeWork& shape);

/// Returns next_rungs() in the unit of the shape's counts.
std::vector<std::size_t> rungs_above(const ShapeWork& shape, std::size_t explored, std::size_t most);

/// Returns the counts that choose_counts() requests of a shape before anything is known; 0: no budget. `groups`: number
/// of groups of the robot.
std::vector<std::size_t> first_counts(const Recipe& recipe, const ShapeWork& shape, std::size_t groups);

/// Calls compute_trees(); a search that ends early keeps its trees so far. If there is no tree yet, a stop cancels the
/// run. After a time limit the result is then the tree with the fewest spheres, or one enclosing sphere where that
/// takes too long as well.
void compute_until_cut(const Workspace& workspace, ShapeWork& work, const std::vector<std::size_t>& counts);

/// Bounds on a number of spheres.
struct Bounds {
    std::size_t least = 0, most = SIZE_MAX;
};

/// Returns the known costs of counts within the bounds.
CostCurve within(const CostCurve& curve, const Bounds& bounds);

/// Counts for the groups without an error from their known costs, and whether they are enough for the goal. Empty if
/// there are not enough spheres for all groups.
struct Shared {
    std::vector<std::size_t> counts;
    bool enough = false;
};
/// Allocates spheres. Groups of one shape get equal counts if their weights are equal. `bounds`: one for each group without an error; empty: no bounds.
Shared share(const std::vector<ShapeWork>& shapes, const std::vector<Group>& groups, const Goal& goal,
             const std::vector<Bounds>& bounds = {});

/// Returns what `measure()` returns, under the stop request of the phase; nothing if that ended it early.
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

/// Measures trees on all cores, as far as there is time, also after a search that ended early: a tree without its
/// measure is useless. Measures each tree of a shape without an error where `known(shape, count)` is false. Calls
/// `keep(shape, count, measured)` in order with the result of `measure(work, tree)`. Where `nothing_known(shape)`, the
/// first tree is measured whatever time that takes. Returns whether there was time for all.
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

/// Adds the costs of the requested counts to the curves: spherize, grow to keep the guarantee, measure. Returns what
/// ended the search early; something is known of every shape then, too.
Cut explore(const Workspace& workspace, std::vector<ShapeWork>& shapes,
            const std::vector<std::vector<std::size_t>>& counts);

/// Explores the curves as far as the goal needs. Returns what ended the search early; something is known of every shape
/// without an error then, too.
Cut explore_for(const Workspace& workspace, std::vector<ShapeWork>& shapes, const std::vector<Group>& groups,
                const Goal& goal);

} // namespace foam::inline runtime
