// Where a run found its inputs, compared with where they are here.
#pragma once

#include "input/inputs_here.hpp"

namespace foam::inline runtime {

/// Returns a sentence for the input, and one for each package folder, that resolves to another place here than in the
/// run, with the setting that corrects it. `here`: absent if the inputs were not found.
std::vector<std::string> inputs_elsewhere(const Record& record, const std::optional<InputsHere>& here);

} // namespace foam::runtime
