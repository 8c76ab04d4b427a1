// Covers made better without ever ceasing to be covers.
#pragma once

#include "cover/occupancy.hpp"
#include "cover/power_cells.hpp"
#include "cover/rated.hpp"

namespace foam::cover {

/// The conditional gradient method (Frank and Wolfe 1956): the balls (centre, radius) that hold a set are a convex set,
/// for |p - c| - r is a convex function; over it the volume that a ball claims is, to first order, least at the tilted
/// enclosing ball. All balls go some way towards theirs, how far a line search tells: what is between two balls that
/// hold a part holds it too. Before each step the surface is shared anew, which takes nothing back: a ball holds its
/// power cell if all together hold the surface. The tilted ball itself is too far where a ball shows a small part of
/// itself only: a flat face would best be held by a half-space.
class ConditionalGradient {
public:
    /// Both must outlive this.
    ConditionalGradient(const FineSkin& skin, const Occupancy& occupancy);

    /// At most so many steps, fewer where they gain nothing. The best cover on the way: all hold the surface, whatever
    /// the balls do. The volume is that of the balls and the solid together.
    Rated improved(Balls balls, int steps);

private:
    double claim(const Balls& balls);
    /// Of what shows outside the solid, with EnclosingBall's signs.
    Vec3 tilt(const Balls& balls, std::size_t i);
    /// Each ball as large as its part asks for.
    void hold_parts(Balls& balls) const;
    Balls towards(const Balls& balls);
    /// The best of `balls` and what lies up to `share` of the way to `end`; the share it took, or 0.
    Rated line_search(const Rated& balls, const Balls& end, double& share);

    const Occupancy& occupancy_;
    PowerCells cells_;
    Points inside_;
    double inside_volume_; ///< of the solid, that each of them stands for, units³
    EnclosingBall enclosing_ball_;
    Exposed exposed_;
    Owners owners_;
};

} // namespace foam::cover
