// What writers of other programs' formats get beside the spheres.
#pragma once

#include <foam/collision/reference_pose.hpp>
#include <foam/runtime/internal/input.hpp>
#include <foam/runtime/internal/links.hpp>

#include <optional>

namespace foam::inline runtime {

/// Fills in the facts of the robot, its rest pose (`reference`, unless the recipe gives one), the pairs that need no check
/// (if a writer lists them), the verdict, and the line of provenance.
void complete_model(const Workspace& workspace, const Input& input,
                    const std::optional<ReferenceConfiguration>& reference, const ProvedLinks& proved,
                    FinishedModel& finished);

} // namespace foam::inline runtime
