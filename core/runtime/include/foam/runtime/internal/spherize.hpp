// From prepared links to spheres: once for every distinct shape, with the budget allocated over the robot.
#pragma once

#include <foam/geometry/solid.hpp>
#include <foam/runtime/internal/prepare.hpp>
#include <foam/sdk/model.hpp>

#include <memory>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

class [[gnu::visibility("hidden")]] RandomPoses;
class [[gnu::visibility("hidden")]] ReferencePose;

/// A unit of spherization: a link, or one collision element of it.
struct Group {
    std::size_t link = 0;              ///< index into the links
    std::vector<std::size_t> elements; ///< of the link
    /// Pose of the first element's frame, in which the shape is spherized, in the link's frame. So equal geometry at
    /// different places (a pair of fingers) is one shape.
    Pose frame;
    double weight = 1;     ///< factor on its volume in the allocation
    std::size_t shape = 0; ///< index of the distinct shape
    SphereTree tree;       ///< link frame; the spherizer's tree, transformed
    /// With spheres that the link keeps: the geometry that they leave uncovered, which `tree` is to cover, in the
    /// link's frame; null: they leave none, or there are none.
    std::shared_ptr<const Solid> uncovered;
    /// The original geometry, in the link's frame; null if it is not built yet.
    std::shared_ptr<const Solid> solid;
    /// The same with its inside, where that counts as geometry; null if it is not built yet.
    std::shared_ptr<const Solid> filled;
    /// Whether `tree` covers already, and its figures are not measured: there is no time.
    bool in_haste = false;
};

struct SpherizedLinks {
    std::vector<Group> groups;
    Cut cut = Cut::none; ///< why the search for better spheres ended early
};

/// Spherizes all links without an error, within the recipe's budget. Errors go to the links. Throws for a budget that
/// cannot be met (fewer spheres than groups), for cancellation, and for a stop before there is a model. `pose`: the
/// reference pose in which spheres of links are to stay apart; null: they need not. `poses`: those in which the
/// allocation is to avoid false contacts; null: it need not.
SpherizedLinks spherize_links(const Workspace& workspace, std::vector<LinkWork>& links, ReferencePose* pose = nullptr,
                              RandomPoses* poses = nullptr);

} // namespace runtime
} // namespace foam
