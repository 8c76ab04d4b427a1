// The candidate counts along which covering spheres build on one another.
#pragma once

#include <foam/base/internal/ladder.hpp>

#include <algorithm>
#include <bit>

namespace foam::inline search::cover {

/// Largest count that builds on the one before. Larger counts build on the next lower one of 12, 14, 16, 20, 24, 28,
/// 32, 40, 48, 56, 64.
constexpr std::size_t every_count = 12;
/// Larger counts are searched by themselves: they are only compared with this one.
constexpr std::size_t most_growing = 64;

/// Returns the candidate count below a count of at least 2.
constexpr std::size_t count_before(std::size_t count) {
    if (count <= every_count) {
        return count - 1;
    }
    if (count > most_growing) {
        return most_growing;
    }
    std::size_t before = every_count;
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
