// The distinct shapes of a robot, and what is known of each.
#pragma once

#include "allocation.hpp"
#include "objective.hpp"
#include "spherize.hpp"

#include "geometry/own_frame.hpp"

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace foam {

/// What a spherizer made of a shape.
struct KnownTrees {
    std::map<std::size_t, SphereTree> trees;  ///< by the number of spheres they have
    std::map<std::size_t, std::size_t> asked; ///< count asked for → count got
    CostCurve curve;
};

/// A distinct shape and what is known of it.
struct ShapeWork {
    std::unique_ptr<Shape> shape;
    geometry::OwnFrame frame;              ///< in which the spherizer gets it
    std::unique_ptr<Shape> own;            ///< the shape in that frame, unless it is the given one
    std::shared_ptr<const Solid> original; ///< of the shape
    StageCall spherizer;
    std::unique_ptr<Spherizer> stage; ///< of that call, once it was made; unless it is isolated
    std::optional<Objective>
        objective;           ///< of its spheres, where they are to cover; nothing: one of the spherizer's own
    Digest digest;           ///< of all that a tree depends on but the seed, the count and the limits of either
    Digest content;          ///< of the geometry as the spherizer sees it
    std::string link, input; ///< of the first group, for messages
    std::vector<std::size_t> groups;
    std::size_t least = 1, most = 1;      ///< bounds of the count
    std::optional<double> max_protrusion; ///< m
    std::vector<ClipPlane> clip;          ///< in the shape's frame
    KnownTrees known;
    StageReport report;
    double cavities = 0;         ///< m³; of the original
    std::set<std::string> calls; ///< of the spherizer whose findings and metrics the run has
    std::optional<Error> error;
    bool tried_to_finish = false; ///< its share of what finishing takes is known
};

/// Whether the shape's spheres are to claim little above all, so that others that claim less may stand in for the
/// spherizer's own: not if its objective is another, nor if they are to be fitted.
bool wants_least_excess(const Recipe& recipe, const ShapeWork& work);

/// One group a link, or one a collision element (recipe: per), for the links without an error.
std::vector<Group> make_groups(const Workspace& workspace, const std::vector<LinkWork>& links);

/// Groups of equal geometry and recipe share a shape; fills in Group::shape.
std::vector<ShapeWork> distinct_shapes(const Workspace& workspace, const std::vector<LinkWork>& links,
                                       std::vector<Group>& groups);

/// Makes ShapeWork::shape, in the frame of its first group's first element. Spherizers that look at the original alone
/// get nothing else.
void build_shape(const Workspace& workspace, const std::vector<LinkWork>& links, const std::vector<Group>& groups,
                 ShapeWork& work);

/// Runs `body` for the shapes that have no error yet, on all cores; errors stay with the shape.
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

} // namespace foam
