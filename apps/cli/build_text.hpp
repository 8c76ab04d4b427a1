// Which build this is.
#pragma once

#include <string>

namespace foam::cli {

/// Returns the commit, the build type and the compiler: "1a2b3c4d5e, Release, g++ 12.2.0"; without the commit where
/// foam was not built in a clone.
std::string build_text();

} // namespace foam::cli
