// The number of spheres of each group.
#pragma once

#include "allocate/exploration.hpp"
#include "allocate/random_poses.hpp"
#include "allocate/reference_pose.hpp"

#include <vector>

namespace foam::inline runtime {

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

} // namespace foam::runtime
