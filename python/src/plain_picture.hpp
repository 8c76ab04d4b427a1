// Pictures without graphics libraries, where the painter of snapshots is not installed: in a wheel.
#pragma once

#include <foam/geometry/figure.hpp>

#include <cstdint>
#include <vector>

namespace foam::python {

/// Returns a picture of a panel from the direction of snapshots, row by row from the top, three bytes a pixel: red,
/// green, blue. Orthographic, with two samples a pixel along each side. O(pixels + triangles).
std::vector<std::uint8_t> plain_picture(const Panel& panel, int width, int height);

} // namespace foam::python
