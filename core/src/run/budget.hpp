// How many spheres each group gets.
#pragma once

#include "exploration.hpp"
#include "reference_pose.hpp"

#include <vector>

namespace foam {

struct ChosenCounts {
    std::vector<std::size_t> of_group;
    Cut cut = Cut::none; ///< of the search
};

/// The count of every group (0 for those with an error), by the recipe's budget; ShapeWork::known then holds a tree of
/// that count. What the budget asks for and cannot have is a finding, and
/// so is a search that was cut. Throws Error(recipe) for a budget below the least
/// that the groups need, and for an excess of geometry without volume. `pose`: where spheres that are shared out are to
/// stay apart; may be null.
ChosenCounts choose_counts(const Workspace& preparing, const std::vector<LinkWork>& links,
                           std::vector<ShapeWork>& shapes, const std::vector<Group>& groups, ReferencePose* pose);

} // namespace foam
