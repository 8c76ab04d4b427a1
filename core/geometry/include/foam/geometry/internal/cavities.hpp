// Cavities that a solid encloses.
#pragma once

#include <foam/geometry/solid.hpp>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// Returns about the volume of the cavities of a solid that is one mesh, m³: of shells wound inwards whose holes are
/// negligible. For any other solid it returns 0, as another part may fill them.
double cavity_volume(const Solid& solid);

} // namespace geometry
} // namespace foam
