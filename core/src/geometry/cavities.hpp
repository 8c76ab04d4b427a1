// Hollows that a solid encloses.
#pragma once

#include <foam/solid.hpp>

namespace foam::geometry {

/// About the volume of the cavities of a solid that is one mesh, m³: of shells without holes that matter, wound
/// inwards. Of any other solid 0: another part may fill them.
double cavity_volume(const Solid& solid);

} // namespace foam::geometry
