// Where a run had found its inputs, for those that lie elsewhere here.
#pragma once

#include "inputs_here.hpp"

namespace foam {

/// A sentence for the input, and one for each folder of packages, that leads somewhere else here than in the run, with
/// what to set. `here`: absent if the inputs were not found.
std::vector<std::string> inputs_elsewhere(const Record& record, const std::optional<InputsHere>& here);

} // namespace foam
