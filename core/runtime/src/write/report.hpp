// What a run writes beside its outputs.
#pragma once

#include <foam/collision/reference_pose.hpp>
#include <foam/runtime/internal/input.hpp>
#include <foam/runtime/internal/links.hpp>
#include <foam/runtime/internal/output.hpp>

#include <optional>
#include <string>

namespace foam::inline runtime {

/// Returns the report. `recipe`: as YAML, with every default. The robot has the pose of the recipe's snapshots.
std::string report_html(const Workspace& workspace, const FinishedModel& finished, const std::string& manifest,
                        const std::string& recipe, const Snapshots& pictures);

/// Fills in the facts of the robot, its rest pose (`reference`, unless the recipe gives one), the pairs that need no check
/// (if a writer lists them), the verdict, and the line of provenance.
void complete_model(const Workspace& workspace, const Input& input,
                    const std::optional<ReferenceConfiguration>& reference, const ProvedLinks& proved,
                    FinishedModel& finished);

} // namespace foam::inline runtime
