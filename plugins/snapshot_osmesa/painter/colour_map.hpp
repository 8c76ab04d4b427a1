// Colours of radii.
#pragma once

#include <array>

namespace foam::snapshot {

/// Red, green, blue, 0 to 255.
using Colour = std::array<unsigned char, 3>;

/// Returns Viridis (van der Walt and Smith 2015, "A better default colormap for Matplotlib"): perceptually uniform,
/// readable in grey and for colour-blind eyes; 256 entries.
const std::array<Colour, 256>& viridis();

/// Returns the entry for `value` within [low, high]; the middle one if the range is empty.
Colour colour_of(double value, double low, double high);

} // namespace foam::snapshot
