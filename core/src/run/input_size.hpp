// How large an input is, and whether that is likely what was meant.
#pragma once

#include "input.hpp"
#include "prepare.hpp"

namespace foam {

/// Of the geometry that was loaded; links that are left out or could not be read do not count.
InputSize input_size(const Robot& robot, const std::vector<LinkWork>& links);

/// Tells the size, and warns of one that hints at another unit: a mesh below 1 mm or above 20 m, spheres that may
/// stand out farther than the input is large.
void tell_input_size(const Workspace& workspace, const Input& input, const std::vector<LinkWork>& links,
                     const InputSize& size);

} // namespace foam
