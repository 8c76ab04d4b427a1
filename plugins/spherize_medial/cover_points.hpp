// The points of the surface that spheres must contain during the search.
#pragma once

#include "frame.hpp"

#include <foam/geometry/solid.hpp>

#include <vector>

namespace foam::medial {

struct CoverOptions {
    std::size_t count = 1000;     ///< points by area
    std::size_t per_triangle = 5; ///< least number on a triangle that is larger than the spacing of the points
};

/// Returns the corners of the surface, which the proof of coverage needs first, and points spread over it by area;
/// local frame. Where corners are denser than the points, one of each neighbourhood stands for the others. The
/// outermost corners are all kept.
std::vector<Vec3> cover_points(const Solid& solid, const Frame& frame, const CoverOptions& options, std::uint64_t seed);

} // namespace foam::medial
