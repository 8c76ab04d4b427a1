// How many elements each shape gets, and the steps that change it.
#pragma once

#include "allocate/exploration.hpp"
#include "input/shapes.hpp"

#include <foam/collision/consequences.hpp>
#include <foam/collision/reference_pose.hpp>
#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>
#include <foam/robot/kinematics.hpp>
#include <foam/runtime/internal/input.hpp>
#include <foam/runtime/internal/links.hpp>

#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace foam::inline runtime {

/// Grows each known tree once, where the guarantee is that it covers. Not thread-safe.
class CoveringElements {
public:
    CoveringElements(const Workspace& workspace, const std::vector<ShapeWork>& shapes)
        : workspace_(workspace), shapes_(shapes) {}

    /// Returns the finest level of a known tree of the group's shape, in the frame of its link.
    Elements of(const Group& group, std::size_t count);

private:
    const Elements& of_shape(std::size_t shape, std::size_t count);

    const Workspace& workspace_;
    const std::vector<ShapeWork>& shapes_;
    std::map<std::pair<std::size_t, std::size_t>, Elements> known_; ///< by shape and count
};

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

/// The poses of one run, and the original geometry of its links.
class RandomPoses {
public:
    /// `seed`: of the run.
    RandomPoses(std::shared_ptr<const Robot> robot, const std::vector<LinkWork>& links, std::uint64_t seed);

    static constexpr std::size_t count = 500;

    /// Returns what the elements of each link do in the poses, with those that it keeps, padded: one level for each of
    /// the run's links, in the link's frame. Throws Error(cancelled).
    Consequences consequences(const std::vector<Elements>& of_link);
    /// Returns the number of the run's links.
    std::size_t links() const { return links_.size(); }
    /// Returns the index in the robot's links of one of the run's.
    std::size_t robot_link(std::size_t link) const { return robot_links_[link]; }

private:
    const std::vector<LinkWork>& links_;
    std::shared_ptr<const Robot> robot_;
    Kinematics kinematics_;
    std::vector<std::size_t> robot_links_;
    LinkSolids solids_; ///< made when they are first needed
    std::vector<std::vector<double>> configurations_;
};

/// Returns an allocation with the fewest false contacts in the poses that was found: contacts of elements of two links
/// whose geometry does not touch. In each round the groups of links with false contacts weigh more, by their share of
/// them, and the budget is allocated anew. `shared`: the allocation without that, which is returned if none is better.
Shared with_fewer_false_contacts(const Workspace& workspace, std::vector<ShapeWork>& shapes,
                                 const std::vector<Group>& groups, const Goal& goal, RandomPoses& poses, Shared shared,
                                 Cut& cut);

/// Returns an allocation in which no spheres of links that are to stay apart overlap, as far as there is one that keeps
/// the limits of protrusion too, and is enough for the goal if `shared` is. `shared`: the best allocation without that
/// condition. The counts of groups whose spheres overlap are restricted to counts without overlap, which are mostly
/// larger, and explored as far as necessary.
Shared keep_apart(const Workspace& workspace, std::vector<ShapeWork>& shapes, const std::vector<Group>& groups,
                  const Goal& goal, ReferencePose& pose, Shared shared, Cut& cut);

/// Reports a finding for each pair of links whose spheres overlap nevertheless.
void report_overlaps(const Workspace& workspace, const FinishedModel& finished, const std::vector<LinkWork>& links,
                     ReferencePose& pose);

/// Returns the common objective of all shapes' spherizers if the worst sphere of the robot decides it: the largest
/// protrusion or the largest radius. Nothing with limits of protrusion, which come first.
std::optional<Objective> common_objective(const Recipe& recipe, const std::vector<ShapeWork>& shapes);

/// Explores counts as far as they may improve the group that is worst by the objective. Returns what ended it early.
/// `figures`: of each shape, m, by the counts that its curve knows.
using Figures = std::vector<std::map<std::size_t, double>>;
Cut explore_worst_first(const Workspace& workspace, std::vector<ShapeWork>& shapes, const std::vector<Group>& groups,
                        Objective objective, std::size_t most, Figures& figures);

/// Returns for each group the fewest spheres such that the worst figure is as small as at most `most` spheres allow.
/// Empty if there are not enough for all.
std::vector<Bounds> bounds_of_best_worst(const std::vector<ShapeWork>& shapes, const std::vector<Group>& groups,
                                         const Figures& figures, std::size_t most);

struct ChosenCounts {
    std::vector<std::size_t> of_group;
    Cut cut = Cut::none; ///< why the search ended early
};

/// Returns the count of every group, 0 for those with an error, according to the recipe's budget. ShapeWork::known then
/// has a tree of that count. A budget that cannot be met and a search that ended early are findings. Throws
/// Error(recipe) for a budget below the least that the groups need, and for an excess budget of geometry without
/// volume. `pose`: the reference pose in which allocated spheres are to stay apart; `poses`: those in which there are
/// to be few false contacts; both may be null, and only one is given.
ChosenCounts choose_counts(const Workspace& preparing, const std::vector<LinkWork>& links,
                           std::vector<ShapeWork>& shapes, const std::vector<Group>& groups, ReferencePose* pose,
                           RandomPoses* poses);

/// Finds the best tree with at most `most` spheres and returns its count, under which ShapeWork::trees has it. The
/// spherizer is called with counts_alone(), and with 12, 24 and 48 where these may be better. With guarantee outer the
/// excess volume never rises with `most` up to 64, whatever the spherizer: the best tree of a count is refined with the
/// numbers of spheres up to the next count, and each of them is measured. Above 64 it is never larger than for 64.
/// Trees with levels between root and finest level get no more spheres. With such trees, with the other guarantees and
/// with half-space constraints the spherizer is also called with `most` itself, and the best tree of all is taken.
std::size_t best_of_at_most(const Workspace& workspace, ShapeWork& work, std::size_t most);

} // namespace foam::inline runtime
