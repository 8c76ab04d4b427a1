// The distinct shapes of a robot, and what is known of each.
#pragma once

#include "allocate/allocation.hpp"
#include "process/process.hpp"

#include <foam/geometry/internal/own_frame.hpp>
#include <foam/runtime/internal/links.hpp>

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace foam::inline runtime {

/// The results of a spherizer for a shape.
struct KnownTrees {
    std::map<std::size_t, SphereTree> trees;  ///< by their size: see size_of()
    std::map<std::size_t, std::size_t> asked; ///< requested count → resulting count
    CostCurve curve;
};

/// A refinement of a shape's spheres.
struct RefinementWork {
    StageCall call;
    bool adds_spheres = false;
    std::unique_ptr<Refiner> refiner;
    std::unique_ptr<Refinement> refinement;
    StageReport report;
};
struct Refinements {
    std::vector<RefinementWork> list; ///< in the recipe's order
    std::mutex mutex;                 ///< of the reports
};

/// A distinct shape and what is known of it.
struct ShapeWork {
    std::unique_ptr<Shape> shape;
    geometry::OwnFrame frame;              ///< in which the spherizer gets the shape
    std::unique_ptr<Shape> own;            ///< the shape in that frame, unless that is the given one
    std::shared_ptr<const Solid> original; ///< of the shape
    std::shared_ptr<const Solid> unfilled; ///< the same without the inside that counts as geometry
    Digest built;                          ///< of its surface as it was built
    StageCall spherizer;
    std::vector<StageCall> refiners;
    bool adds_spheres = false; ///< whether one of these does
    StartedSearch search;      ///< of that call
    std::optional<Objective>
        objective;           ///< for covering spheres; nothing: the spherizer has an objective that foam does not know
    Digest digest;           ///< of everything that a tree depends on, except seed, count and limits of the count
    Digest content;          ///< of the geometry that the spherizer gets
    std::string link, input; ///< of the first group, for messages
    std::vector<std::size_t> groups;
    std::size_t least = 1, most = 1;      ///< bounds of the count
    std::vector<Element::Kind> kinds;     ///< that the spherizer may return
    std::size_t unit = 1;                 ///< of counts: with a budget of cost, the price of the cheapest element
    std::size_t most_elements = SIZE_MAX; ///< with a budget of cost: bound of their number
    std::optional<double> max_protrusion; ///< m
    std::vector<ClipPlane> clip;          ///< in the shape's frame
    KnownTrees known;
    std::unique_ptr<Refinements> refinements; ///< made with the geometry
    StageReport report;
    double cavities = 0;         ///< m³; of the original geometry
    std::set<std::string> calls; ///< calls of the spherizer whose findings and metrics the run has
    std::optional<Error> error;
    bool tried_to_finish = false; ///< its time for finishing is in the reserve
};

/// Returns whether the spheres of the shape are to have the least excess volume, so that other spheres with less may
/// replace those of the spherizer: not with another objective, nor with guarantee fitted.
bool wants_least_excess(const Recipe& recipe, const ShapeWork& work);

/// Prices are counted in hundredths: a budget of cost is a count of these.
constexpr double price_step = 0.01;
/// Returns the recipe's budget of the whole robot: a number of elements, or a cost in hundredths; nothing: none.
std::optional<std::size_t> total_of(const Recipe& recipe);
/// Returns what elements take of that budget: their number, or their cost, rounded up.
std::size_t size_of(const Recipe& recipe, const Elements& elements);
/// Returns the word for several of what the shapes get: spheres or elements.
const char* plural_of(const std::vector<ShapeWork>& shapes);

/// Returns one group per link, or one per collision element (recipe: per), for the links without an error.
std::vector<Group> make_groups(const Workspace& workspace, const std::vector<LinkWork>& links);

/// Returns the pose of an element in its group's frame; exactly the identity for the first element.
Pose relative_pose(const Group& group, const LinkWork& link, std::size_t element);
/// Returns the kept spheres in the frame in which the group's shape is spherized.
std::vector<Sphere> kept_of(const Group& group, const LinkWork& link);
/// Returns whether the spherizer uses nothing but the original geometry.
bool original_only(const Workspace& workspace, const StageCall& spherizer);

/// Returns the distinct shapes: groups with equal recipe share one if their geometry is equal, or the image of the
/// other's: turned or mirrored. Sets Group::shape and Group::from_shape. Reports the mirrored ones.
std::vector<ShapeWork> distinct_shapes(const Workspace& workspace, const std::vector<LinkWork>& links,
                                       std::vector<Group>& groups);

/// Builds ShapeWork::shape, in the frame of the first element of its first group. Spherizers that use only the original
/// geometry get nothing else.
void build_shape(const Workspace& workspace, const std::vector<LinkWork>& links, const std::vector<Group>& groups,
                 ShapeWork& work);

/// Runs `body` for the shapes without an error, on all cores. Keeps errors with the shape.
template <class Body> void for_each_shape(std::vector<ShapeWork>& shapes, Body&& body) {
    parallel_for(shapes.size(), [&](std::size_t s) {
        if (shapes[s].error) {
            return;
        }
        try {
            body(s);
        } catch (const Error& error) {
            if (error.code() == ErrorCode::cancelled) {
                throw;
            }
            shapes[s].error.emplace(error);
        }
    });
}

} // namespace foam::inline runtime
