// report.html: the run for people to look at, in one file.
#pragma once

#include "debug.hpp"

#include <string>

namespace foam {

/// `recipe`: as YAML, with every default. The robot stands as the recipe's snapshots show it.
std::string report_html(const Workspace& workspace, const FinishedModel& finished, const std::string& manifest,
                        const std::string& recipe, const Snapshots& pictures);

} // namespace foam
