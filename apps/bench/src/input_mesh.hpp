// The mesh of an experiment.
#pragma once

#include "bench.hpp"

#include <foam/bench/experiment.hpp>
#include <foam/geometry/mesh.hpp>
#include <foam/yaml/findings.hpp>

#include <string>
#include <vector>

namespace foam::inline bench::experiment {

/// The candidates for a mesh, as an experiment names them.
struct MeshCandidates {
    std::vector<std::string> references;
    yaml::Location where;
};

/// Loads the first candidate that exists; `chosen` becomes its reference. A relative one starts beside the experiment,
/// then in the folder FOAM_SHARED. Throws Error(input).
Mesh input_mesh(const Bench& bench, const Experiment& experiment, const MeshCandidates& candidates,
                std::string& chosen);

} // namespace foam::bench::experiment
