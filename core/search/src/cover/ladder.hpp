// The candidate counts along which covering spheres build on one another.
#pragma once

#include <foam/base/internal/ladder.hpp>

#include <bit>

namespace foam::inline search::cover {

/// Largest count that builds on the one before. Larger counts build on the next lower one of 12, 14, 16, 20, 24, 28,
/// 32, 40, ….
constexpr std::size_t every_count = 12;

/// Returns the candidate count below a count of at least 2.
constexpr std::size_t count_before(std::size_t count) {
    if (count <= every_count) {
        return count - 1;
    }
    std::size_t before = every_count;
    while (rung_above(before) < count) {
        before = rung_above(before);
    }
    return before;
}

/// Returns the count on whose covering spheres the effort fast builds: as above up to 16, then the next lower power of
/// two, so that all of them together take about twice as long as the last one.
constexpr std::size_t quick_count_before(std::size_t count) {
    constexpr std::size_t last_small = 16;
    return count <= last_small ? count_before(count) : std::bit_floor(count - 1);
}

} // namespace foam::search::cover
