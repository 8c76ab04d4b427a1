// The candidate counts along which covering spheres build on one another.
#pragma once

#include <foam/base/internal/ladder.hpp>

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

} // namespace foam::search::cover
