// Links in the reference pose: which of them must not touch, and where their spheres overlap.
#pragma once

#include <foam/collision/reference_pose.hpp>
#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>
#include <foam/runtime/internal/prepare.hpp>

#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace foam::inline runtime {

/// The elements of a link, in its frame.
struct ElementsOfLink {
    std::size_t link = 0; ///< index into the links
    Elements elements;
};

/// Two entries of a list of ElementsOfLink that overlap.
struct Overlap {
    std::size_t first = 0, second = 0;
    double depth = 0; ///< m; of the two elements that overlap most; from below where one is not a sphere
};

/// Returns the original geometry of each link of the robot; null: none, or it could not be loaded.
LinkSolids solids_of(const Robot& robot, const std::vector<LinkWork>& links);

/// Returns the reference pose of a run, and reports where it differs from zero; nothing where no step of the run needs
/// one: `self_collision`, and outputs with a rest pose. It is the pose of `self_collision`, else the robot's
/// `default_pose`, else one in which no links touch: a <group_state> of an SRDF that an output edits, zero, or one that
/// is found. Throws Error(recipe) for a joint that the robot does not have or that does not move independently.
std::optional<ReferenceConfiguration> reference_of(const Workspace& workspace, std::shared_ptr<const Robot> robot,
                                                   const std::vector<LinkWork>& links);

/// The links of one run in its reference pose. Not thread-safe.
class ReferencePose {
public:
    ReferencePose(std::shared_ptr<const Robot> robot, const std::vector<double>& configuration,
                  const std::vector<LinkWork>& links);

    /// Returns the overlaps of elements of links that are to stay apart: links that are not neighbours and whose
    /// geometry does not touch in this pose. Elements also count if their distance is below the rounding of written
    /// numbers.
    std::vector<Overlap> overlaps(const std::vector<ElementsOfLink>& all);

private:
    bool geometry_touches(std::size_t a, std::size_t b);

    const std::vector<LinkWork>& links_;
    std::vector<Pose> poses_; ///< of the links in the root link's frame
    std::vector<std::vector<bool>> neighbours_;
    std::map<std::size_t, std::shared_ptr<const Solid>> solids_; ///< in the link's frame
    std::map<std::pair<std::size_t, std::size_t>, bool> touching_;
};

} // namespace foam::runtime
