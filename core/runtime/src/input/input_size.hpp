// The size of an input, and whether it is plausible.
#pragma once

#include <foam/runtime/internal/input.hpp>
#include <foam/runtime/internal/prepare.hpp>

namespace foam::inline runtime {

/// Returns the size of the loaded geometry, without links that are skipped or could not be read.
InputSize input_size(const Robot& robot, const std::vector<LinkWork>& links);

/// Reports the size, and warns of one that suggests another unit: a mesh below 1 mm or above 20 m, a max_protrusion
/// above the size of the input.
void tell_input_size(const Workspace& workspace, const Input& input, const std::vector<LinkWork>& links,
                     const InputSize& size);

} // namespace foam::runtime
