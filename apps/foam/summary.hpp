// The result of a run for people.
#pragma once

#include <foam/runtime/run.hpp>

#include <string>

namespace foam::cli {

/// A table: a line a link, the total, and whether cover is proved.
std::string table_of(const RunResult& result, Guarantee guarantee);

} // namespace foam::cli
