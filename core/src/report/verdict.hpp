// What a run has proved, in a line.
#pragma once

#include "report.hpp"

#include <string>

namespace foam::report {

std::string guarantee_of(const Report& report);
bool certified(const Report& report);
/// As HTML.
std::string verdict(const Report& report);
/// Which links the proof is not of, as HTML; empty if there are none.
std::string omissions(const Report& report);
/// The class of the element that holds it.
std::string verdict_class(const Report& report);

} // namespace foam::report
