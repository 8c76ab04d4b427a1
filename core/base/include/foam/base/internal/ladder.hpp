// Candidate counts of spheres: all small ones, then with growing steps.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>

namespace foam {
inline namespace [[gnu::visibility("default")]] base {

/// Returns the least candidate count above `count`: 1, 2, 3, 4, 5, 6, 7, 8, then four per octave: 10, 12, 14, 16, 20,
/// 24, 28, 32… and two from 64 on: 96, 128, 192…
constexpr std::size_t rung_above(std::size_t count) {
    constexpr std::size_t many = 64; // each of so many spheres has little effect, and the search takes long
    const std::size_t octave = std::bit_floor(std::max<std::size_t>(count, 4)), step = octave / (count < many ? 4 : 2);
    return count - count % step + step;
}

/// Returns the same with two per octave: 1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48…
constexpr std::size_t sparse_rung_above(std::size_t count) {
    const std::size_t octave = std::bit_floor(std::max<std::size_t>(count, 2)), step = octave / 2;
    return count - count % step + step;
}

} // namespace base
} // namespace foam
