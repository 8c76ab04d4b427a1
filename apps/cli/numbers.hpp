// The check of numbers on the command line.
#pragma once

#include <CLI/CLI.hpp>

#include <cstdint>
#include <limits>

namespace foam::cli {

/// Returns the check that a word is a whole number within these bounds.
CLI::Validator whole_number(std::uint64_t least = 0, std::uint64_t most = std::numeric_limits<std::uint64_t>::max());
/// Returns the check that a word is a finite number above, or from, `least`.
CLI::Validator number_above(double least);
CLI::Validator number_from(double least);
/// Returns the check that a word is a number between these two.
CLI::Validator number_between(double below, double above);

} // namespace foam::cli
