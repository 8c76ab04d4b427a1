// Links whose spheres are much looser than those of the robot.
#pragma once

#include <foam/runtime/internal/links.hpp>

namespace foam::inline runtime {

/// Warns of small links that the allocation gave few spheres with much excess, such as fingers, while other links got
/// many.
void tell_loose_links(const Workspace& workspace, const FinishedModel& finished);

} // namespace foam::inline runtime
