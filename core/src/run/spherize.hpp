// From prepared links to spheres: every distinct shape once, the budget shared over the robot.
#pragma once

#include "prepare.hpp"

#include <foam/model.hpp>
#include <foam/solid.hpp>

#include <memory>
#include <vector>

namespace foam {

class ReferencePose;

/// What is spherized as one: a link, or one collision element of it.
struct Group {
    std::size_t link = 0;              ///< index into the links
    std::vector<std::size_t> elements; ///< of the link
    /// From the frame of the first element, in which the shape is spherized, to the link's. Equal geometry at different
    /// places (a pair of fingers) is one shape that way.
    Pose frame;
    double weight = 1;     ///< of its wrong volume in the sharing of spheres
    std::size_t shape = 0; ///< index of the distinct shape
    SphereTree tree;       ///< link frame; as the spherizer made it, moved
    /// The geometry as the URDF gives it, in the link's frame; null if it is yet to be made.
    std::shared_ptr<const Solid> solid;
};

struct SpherizedLinks {
    std::vector<Group> groups;
    Cut cut = Cut::none; ///< of the search for better spheres
};

/// Spherizes all links without an error, within the recipe's budget. Errors go to the links. Throws for a budget that
/// cannot be kept (fewer spheres than groups), for cancellation, and for a stop before there is a model.
/// `pose`: where spheres of links are to stay apart; null: nowhere.
SpherizedLinks spherize_links(const Workspace& workspace, std::vector<LinkWork>& links, ReferencePose* pose = nullptr);

} // namespace foam
