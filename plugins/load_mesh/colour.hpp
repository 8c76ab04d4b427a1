// Colours as numbers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace foam::load_mesh {

/// Returns 0xRRGGBBAA of shares from 0 to 1; others are moved there. A colour that cannot be seen is 0: none.
inline std::uint32_t colour_number(const std::array<double, 4>& shares) {
    std::uint32_t colour = 0;
    for (const double share : shares) {
        const double inside = std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0;
        colour = colour << 8 | static_cast<std::uint32_t>(std::lround(255 * inside));
    }
    return (colour & 0xFFU) == 0 ? 0 : colour;
}

} // namespace foam::load_mesh
