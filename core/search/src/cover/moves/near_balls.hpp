// The neighbours of balls that move a little at a time.
#pragma once

#include "cover/measured/points.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace foam::inline search::cover {

/// For each ball, the balls whose surfaces come near its own. The lists are longer than necessary by a margin, so that
/// they stay valid while balls move by less.
class NearBalls {
public:
    /// Finds the neighbours anew if the balls have moved too far, or if their number has changed; else O(n). The lists
    /// serve gaps up to `gap` at least.
    void update(const Balls& balls, float gap = 0);
    /// Returns all balls that come to within `gap` of ball `i`, ascending, and perhaps some more. What is returned is
    /// valid until the next call.
    std::span<const std::uint32_t> of(std::size_t i, float gap = 0);
    /// Returns the largest gap for which of() looks nothing up.
    float listed_gap() const { return left_; }

private:
    void find(const Balls& balls, float gap);
    /// Finds balls that come to within more than listed_gap().
    void look_up(std::size_t i, float gap);

    Balls then_;                       ///< the balls of the last search
    float margin_ = 0;                 ///< of that search
    float left_ = -1;                  ///< what moves since then have left of it
    std::vector<std::uint32_t> order_; ///< the balls by their low ends along x
    std::vector<float> high_;          ///< the highest end along x of each of these and those before it
    std::vector<std::vector<std::uint32_t>> lists_;
    std::vector<std::uint32_t> looked_up_;
};

} // namespace foam::inline search::cover
