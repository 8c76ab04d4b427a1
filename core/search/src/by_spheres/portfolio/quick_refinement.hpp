// Descents in milliseconds from several starts.
#pragma once

#include "by_spheres/descent/descent.hpp"
#include "by_spheres/portfolio/problem.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace foam::inline search::by_spheres {

/// Number of balls above which they may leave a cavity in a solid.
constexpr std::size_t few_balls = 16;
constexpr std::size_t most_in_a_row = 6; ///< cells of a grid that is a start
/// Returns starts: the balls divided until there are `count`, grids, and `clusterings` clusterings of the body.
std::vector<Balls> quick_starts(const Points& some, const Balls& before, std::size_t count, const Points& body,
                                std::size_t clusterings, std::uint64_t seed);
/// Returns how many starts of a search for so many balls are worth a refinement.
std::size_t starts_worth_refining(std::size_t balls);

/// Descends from the starts on some points of the surface, and refines the best `kept` on more points. Returns them,
/// the best first, at least one; their balls are fitted to their parts of the surface, so that they cover. `occupancy`:
/// of the solid; null: cavities do not matter. `stopped`: true ends it after the step at hand.
std::vector<CoverCandidate> refined_best(const DescentSurface& surface, const Occupancy* occupancy, std::size_t count,
                                         std::vector<Balls> starts, std::size_t kept,
                                         const std::function<bool()>& stopped);

} // namespace foam::search::by_spheres
