// The counts along which covers build on one another.
#pragma once

#include "data/ladder.hpp"

namespace foam::cover {

/// The rung below a count of at least 2.
constexpr std::size_t count_before(std::size_t count) {
    std::size_t before = 1;
    while (rung_above(before) < count) {
        before = rung_above(before);
    }
    return before;
}

} // namespace foam::cover
