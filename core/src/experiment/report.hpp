// results.md of an experiment.
#pragma once

#include "bench.hpp"

#include <string>

namespace foam::experiment {

/// Title, what was measured, figures and tables; then what it was measured on: machine, compiler, versions, digest of
/// the experiment's text.
std::string to_markdown(const Experiment& experiment, const Outcome& outcome, const Registry& registry,
                        std::size_t threads);

} // namespace foam::experiment
