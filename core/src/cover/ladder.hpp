// The counts along which covers build on one another.
#pragma once

#include <bit>
#include <cstddef>

namespace foam::cover {

/// Counts up to this build on the one before; larger ones on the next below of 12, 14, 16, 20, 24, 28, 32, 40, ….
constexpr std::size_t every_count = 12;

/// The rung below a count of at least 2.
constexpr std::size_t count_before(std::size_t count) {
    if (count <= every_count) {
        return count - 1;
    }
    std::size_t before = every_count, step = 2;
    while (before + step < count) {
        before += step;
        step = std::bit_floor(before) / 4;
    }
    return before;
}

} // namespace foam::cover
