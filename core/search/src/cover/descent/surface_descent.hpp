// The quick descent on the surface of a solid.
#pragma once

#include "cover/measured/fine_surface.hpp"
#include "cover/descent/quick_descent.hpp"

namespace foam::inline search::cover {

/// A surface in small triangles, and points that represent it.
struct DescentSurface {
    FineSurface skin;
    Points some, most; ///< subsets of its points: for the first estimate, for a descent

    /// Makes a surface fine enough for `balls` balls.
    DescentSurface(const Solid& solid, const Frame& frame, std::size_t balls);
    static std::size_t pieces_for(std::size_t balls);
};

/// Directions in which descents compute the exposed surface of a ball; they are turned from step to step, so that none
/// is preferred.
const std::vector<Points>& directions_of_steps();

/// Returns the balls after a descent that uses the points that may come to lie outside, and those where balls meet.
/// Splits first add missing balls up to `count`. The result contains those points, not yet the surface.
Balls descended(const DescentSurface& surface, const Occupancy* occupancy, Balls balls, std::size_t count,
                const QuickDescentPlan& plan);

} // namespace foam::search::cover
