// Which balls hold points, and radii that do.
#pragma once

#include "cover/points.hpp"

namespace foam::cover {

/// Of points the ball in which each lies deepest, and how far it is outside that one (negative inside).
struct Deepest {
    std::vector<std::uint32_t> ball;
    std::vector<float> gap;

    /// Of `count` points, which none has yet.
    void clear(std::size_t count);
    /// Gives ball `i` those of the points from `begin` to `end` that lie deeper in it.
    void offer(const Points& points, std::size_t begin, std::size_t end, const Balls& balls, std::uint32_t i);
};
void find_owners(const Points& points, const Balls& balls, Deepest& owners);

/// Radii as large as the points that lie deepest in each ball ask for, in a few rounds: what one ball gives up another
/// may have held.
void tighten(const Points& points, Balls& balls);

} // namespace foam::cover
