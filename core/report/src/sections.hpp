// The sections of a report, each a <section>, or empty if it has no content.
#pragma once

#include <foam/report/internal/report.hpp>

namespace foam::inline report {

std::string header_section(const Report& report);    ///< name and what is proved
std::string summary_section(const Report& report);   ///< figures of the whole model
std::string viewer_section(const Report& report);    ///< 3-D view and its controls
std::string links_section(const Report& report);     ///< table of figures
std::string radii_section(const Report& report);     ///< histogram
std::string stages_section(const Report& report);    ///< each link after each stage
std::string proof_section(const Report& report);     ///< the certificate
std::string findings_section(const Report& report);  ///< findings of stages
std::string recipe_section(const Report& report);    ///< as run
std::string files_section(const Report& report);     ///< inputs, outputs, versions
std::string reproduce_section(const Report& report); ///< commands
std::string execution_section(const Report& report); ///< times

} // namespace foam::report
