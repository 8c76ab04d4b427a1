// Spheres for links that are to stay apart.
#pragma once

#include "exploration.hpp"
#include "links.hpp"
#include "reference_pose.hpp"

namespace foam {

/// A sharing in which no spheres of links that are to stay apart overlap, as far as there is one that keeps limits of
/// protrusion as well and is enough for the goal if `shared` is: the best without regard to that. The counts of groups
/// whose spheres overlap are bound to some that do not, which mostly are more, and explored as far as that takes.
Shared keep_apart(const Workspace& workspace, std::vector<ShapeWork>& shapes, const std::vector<Group>& groups,
                  const Goal& goal, ReferencePose& pose, Shared shared, Cut& cut);

/// A finding for each pair of links of which spheres overlap all the same.
void report_overlaps(const Workspace& workspace, const FinishedModel& finished, const std::vector<LinkWork>& links,
                     ReferencePose& pose);

} // namespace foam
