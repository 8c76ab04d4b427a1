// Dilated inner balls that cover a surface.
#pragma once

#include "cover/measured/distance_field.hpp"

namespace foam::inline search::cover {

/// Returns at most `count` balls about nodes of the field, each dilated by the same length, the least by which they
/// contain the points: about a node of depth d the ball has the radius d + length. A greedy cover tests whether a
/// length is sufficient, always with the ball that contains most of the remaining points (Stolpner, Kry and Siddiqi
/// 2011 dilate medial balls; Wang et al. 2024, "Coverage Axis++", choose among inner balls greedily), and the length is
/// bisected. Empty if only one ball about the points is found.
Balls dilated_inner_balls(const DistanceField& field, const Points& points, std::size_t count);

} // namespace foam::search::cover
