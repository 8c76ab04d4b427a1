// How far the visual geometry extends beyond the spheres.
#pragma once

#include <foam/runtime/internal/links.hpp>

#include <vector>

namespace foam::inline runtime {

/// Sets LinkReport::visual_gap of the links with spheres and visual geometry, or why it is not known. Does nothing if
/// the spheres cover the visual geometry anyway. The gap is an upper bound within 0.1 %, by certify().
void measure_visual_gaps(const Workspace& workspace, const FinishedModel& finished, std::vector<LinkWork>& links);

} // namespace foam::inline runtime
