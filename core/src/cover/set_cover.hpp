// Dilated inner balls that cover a surface.
#pragma once

#include "cover/distance_field.hpp"

namespace foam::cover {

/// At most `count` balls about nodes of the field, each reaching out of the solid by the same length, the least by
/// which they hold the points: about a node of depth d the ball has the radius d + length. Whether a length is enough
/// is asked of a greedy cover, always the ball that holds most of what is left (Stolpner, Kry and Siddiqi 2011 dilate
/// medial balls; Wang et al. 2024, "Coverage Axis++", choose among inner balls greedily), and the length is bisected.
/// Empty if one ball about the points is all that is found.
Balls dilated_inner_balls(const DistanceField& field, const Points& points, std::size_t count);

} // namespace foam::cover
