// The candidate counts along which covering spheres build on one another.
#pragma once

#include <foam/base/internal/ladder.hpp>

#include <algorithm>
#include <bit>

namespace foam::inline search::cover {

/// Largest count that builds on smaller ones. Larger counts are searched by themselves: they are only compared with
/// this one.
constexpr std::size_t most_growing = 64;

/// Returns the candidate count below a count of at least 2: 1 to 8, 10, 12, 14, 16, 20, 24, 28, 32, 40, 48, 56, 64.
constexpr std::size_t count_before(std::size_t count) {
    if (count > most_growing) {
        return most_growing;
    }
    std::size_t before = 1;
    while (rung_above(before) < count) {
        before = rung_above(before);
    }
    return before;
}

/// Returns the same for Effort::fast: above 8 balls only 16, 32 and 64 are candidates.
constexpr std::size_t quick_count_before(std::size_t count) {
    constexpr std::size_t few = 8;
    return count <= few ? count_before(count) : std::min(std::bit_floor(count - 1), most_growing);
}

/// Returns whether a candidate count above 16 lies between those of two per octave: 20, 28, 40, 56.
constexpr bool is_between(std::size_t count) {
    return rung_above(count - 1) == count && sparse_rung_above(count - 1) != count;
}

} // namespace foam::search::cover
