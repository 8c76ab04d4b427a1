// Getting to know what spheres cost each shape, as far as that decides who gets how many.
#pragma once

#include "shapes.hpp"

#include <optional>
#include <type_traits>
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
/// a time limit it is the tree of the fewest spheres.
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

/// Measures trees on all cores, those of a search that was cut, too: it takes a moment, and they are of no use without.
/// Of the shapes without an error, each tree of which `known(shape, count)` is false; `keep(shape, count, measured)` is
/// called in their order with what `measure(work, tree)` gave.
template <class Known, class Measure, class Keep>
void measure_trees(const Workspace& workspace, const std::vector<ShapeWork>& shapes, Known known, Measure measure,
                   Keep keep) {
    struct Point {
        std::size_t shape, count;
        std::invoke_result_t<Measure&, const ShapeWork&, const SphereTree&> measured{};
    };
    std::vector<Point> points;
    for (std::size_t s = 0; s < shapes.size(); ++s) {
        for (const auto& [count, tree] : shapes[s].known.trees) {
            if (!shapes[s].error && !known(s, count)) {
                points.push_back({s, count});
            }
        }
    }
    const Workspace measuring = workspace.in(Phase::finishing);
    parallel_for(points.size(), [&](std::size_t i) {
        measuring.check_cancelled();
        const ShapeWork& work = shapes[points[i].shape];
        points[i].measured = measure(work, work.known.trees.at(points[i].count));
    });
    for (const Point& point : points) {
        keep(point.shape, point.count, point.measured);
    }
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
