// The proved properties of a run, in one line.
#pragma once

#include <foam/report/internal/report.hpp>

#include <string>

namespace foam::inline report {

std::string guarantee_of(const Report& report);
bool certified(const Report& report);
/// Returns whether some links have elements that are no spheres.
bool has_other_elements(const Report& report);
/// Returns the verdict as HTML.
std::string verdict(const Report& report);
/// Returns "collision geometry", or the other geometry that is covered.
std::string covered_geometry(const Report& report);
/// Returns the links that the proof leaves out, as HTML; empty if there are none.
std::string omissions(const Report& report);
/// Returns the class of the verdict's element.
std::string verdict_class(const Report& report);

} // namespace foam::report
