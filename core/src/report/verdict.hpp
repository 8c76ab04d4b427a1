// What a run has proved, in a line.
#pragma once

#include "report.hpp"

#include <string>

namespace foam::report {

std::string guarantee_of(const Report& report);
bool certified(const Report& report);
std::string verdict(const Report& report);
/// The class of the element that holds it.
std::string verdict_class(const Report& report);

} // namespace foam::report
