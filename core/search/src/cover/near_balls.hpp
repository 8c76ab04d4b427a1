// The neighbours of balls that move a little at a time.
#pragma once

#include "points.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace foam::inline search::cover {

/// For each ball, the balls whose surfaces come near its own. The lists are longer than necessary by a margin, so that
/// they stay valid while balls move by less.
class NearBalls {
public:
    /// Finds the neighbours anew if the balls have moved too far, or if their number has changed; else O(n).
    void update(const Balls& balls);
    /// Returns all balls that come to within `gap` of ball `i`, ascending, and perhaps some more.
    std::span<const std::uint32_t> of(std::size_t i, float gap = 0) const;

private:
    void find(const Balls& balls);

    Balls then_;       ///< the balls of the last search
    float margin_ = 0; ///< of that search
    float left_ = -1;  ///< what moves since then have left of it
    std::vector<std::uint32_t> order_, all_;
    std::vector<std::vector<std::uint32_t>> lists_;
};

} // namespace foam::inline search::cover
