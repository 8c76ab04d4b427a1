// report.html: a report of the run in one file.
#pragma once

#include <foam/runtime/internal/debug.hpp>

#include <string>

namespace foam::inline runtime {

/// Returns the report. `recipe`: as YAML, with every default. The robot has the pose of the recipe's snapshots.
std::string report_html(const Workspace& workspace, const FinishedModel& finished, const std::string& manifest,
                        const std::string& recipe, const Snapshots& pictures);

} // namespace foam::runtime
