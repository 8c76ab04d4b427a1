// The volume that balls claim, and radii that hold points.
#pragma once

#include "cover/points.hpp"

namespace foam::cover {

/// vol(U) in units³ by the divergence theorem over the exposed directions; relative error about 1/directions.
double claimed_volume(const Balls& balls, const Points& directions);

/// Of every point the ball in which it lies deepest, and how far it is outside that one (negative inside).
void find_owners(const Points& points, const Balls& balls, std::vector<std::uint32_t>& owner, std::vector<float>& gap);

/// Radii as large as the points that lie deepest in each ball ask for, in a few rounds: what one ball gives up another
/// may have held.
void tighten(const Points& points, Balls& balls);

} // namespace foam::cover
