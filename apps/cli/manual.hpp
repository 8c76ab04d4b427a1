// Manual pages, made from the declared commands and options.
#pragma once

#include "described.hpp"

#include <string>

namespace foam::cli {

/// Returns the page of the program (`command` empty: foam.1), or that of a command (foam-run.1), in the man macros of
/// roff. Throws Error(usage) for a command that the program does not have.
std::string manual_page(const DescribedProgram& program, const std::string& command, const std::string& version);

} // namespace foam::cli
