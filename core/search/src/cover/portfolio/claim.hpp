// The balls in which points lie deepest, and radii that contain the points.
#pragma once

#include "cover/measured/points.hpp"

namespace foam::inline search::cover {

/// For each point, the ball in which it lies deepest, and its distance outside that ball (negative inside).
struct Deepest {
    std::vector<std::uint32_t> ball;
    std::vector<float> gap;

    /// Resets to `count` points without a ball.
    void clear(std::size_t count);
    /// Assigns to the balls `named` those of the points from `begin` to `end` that lie deeper in one of them than in
    /// their ball so far. Of equal balls, the first counts.
    void offer(const Points& points, std::size_t begin, std::size_t end, const Balls& balls,
               std::span<const std::uint32_t> named);
};
void find_owners(const Points& points, const Balls& balls, Deepest& owners);

/// Sets each radius to the least that contains the points that lie deepest in the ball. It takes a few rounds, as a
/// smaller ball may leave points to others.
void tighten(const Points& points, Balls& balls);

} // namespace foam::search::cover
