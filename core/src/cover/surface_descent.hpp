// The quick descent on the surface of a solid.
#pragma once

#include "cover/fine_skin.hpp"
#include "cover/quick_descent.hpp"

namespace foam::cover {

/// A surface in small triangles, and points that stand for it.
struct DescentSurface {
    FineSkin skin;
    Points some, most; ///< of its points: for a first look, for a descent

    /// Fine enough for so many balls.
    DescentSurface(const Solid& solid, const Frame& frame, std::size_t balls);
    static std::size_t pieces_for(std::size_t balls);
};

/// Directions of a ball in which descents ask what shows; turned from step to step, so that none is preferred.
const std::vector<Points>& directions_of_steps();

/// The balls after a descent that minds the points that may come to lie outside, and where balls meet. Those that are
/// missing up to `count` are made by splits first. They hold those points, not yet the surface.
Balls descended(const DescentSurface& surface, const Occupancy* occupancy, Balls balls, std::size_t count,
                const QuickDescentPlan& plan);

} // namespace foam::cover
