// results.md and measured_on.csv of an experiment.
#pragma once

#include "bench.hpp"

#include <string>

namespace foam::inline bench::experiment {

/// What it was measured on: machine, compiler, versions, digest of the experiment's text.
Table circumstances(const Experiment& experiment, const Registry& registry, std::size_t threads);

/// Title, what was measured, figures and tables; then what it was measured on.
std::string to_markdown(const Experiment& experiment, const Outcome& outcome, const Table& measured_on);

} // namespace foam::bench::experiment
