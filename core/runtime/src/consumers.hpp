// What writers of other programs' formats get beside the spheres.
#pragma once

#include <foam/runtime/internal/input.hpp>
#include <foam/runtime/internal/links.hpp>

namespace foam::inline runtime {

/// Fills in the facts of the robot, the pairs that need no check (if a writer lists them), and the line of provenance.
void complete_model(const Workspace& workspace, const Input& input, FinishedModel& finished);

} // namespace foam::inline runtime
