// The counts along which covers build on one another.
#pragma once

#include "data/ladder.hpp"

namespace foam::cover {

/// Counts up to this build on the one before; larger ones on the next below of 12, 14, 16, 20, 24, 28, 32, 40, ….
constexpr std::size_t every_count = 12;

/// The rung below a count of at least 2.
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

} // namespace foam::cover
