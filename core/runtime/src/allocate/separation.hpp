// Allocation for links whose spheres are to stay apart.
#pragma once

#include "allocate/exploration.hpp"
#include "allocate/reference_pose.hpp"

#include <foam/runtime/internal/links.hpp>

namespace foam::inline runtime {

/// Returns an allocation in which no spheres of links that are to stay apart overlap, as far as there is one that keeps
/// the limits of protrusion too, and is enough for the goal if `shared` is. `shared`: the best allocation without that
/// condition. The counts of groups whose spheres overlap are restricted to counts without overlap, which are mostly
/// larger, and explored as far as necessary.
Shared keep_apart(const Workspace& workspace, std::vector<ShapeWork>& shapes, const std::vector<Group>& groups,
                  const Goal& goal, ReferencePose& pose, Shared shared, Cut& cut);

/// Reports a finding for each pair of links whose spheres overlap nevertheless.
void report_overlaps(const Workspace& workspace, const FinishedModel& finished, const std::vector<LinkWork>& links,
                     ReferencePose& pose);

} // namespace foam::runtime
