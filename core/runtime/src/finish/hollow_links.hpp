// Links whose geometry is mostly a cavity.
#pragma once

#include <foam/runtime/internal/links.hpp>

namespace foam::inline runtime {

/// Tells of links whose material fills little of their box and is thin, unless the recipe fills them: their figures are
/// relative to little volume.
void tell_hollow_links(const Workspace& workspace, const FinishedModel& finished);

} // namespace foam::inline runtime
