// Refinement of covering balls that keeps them covering at every step.
#pragma once

#include "cover/portfolio/cover_candidate.hpp"
#include "cover/measured/occupancy.hpp"
#include "cover/starts/power_cells.hpp"

namespace foam::inline search::cover {

/// The conditional gradient method (Frank and Wolfe 1956). The balls (centre, radius) that contain a set are a convex
/// set, as |p - c| - r is a convex function. Over it the excess volume of a ball is, to first order, least at the
/// tilted enclosing ball. All balls move part of the way towards theirs, by a line search: an interpolation of two
/// balls that contain a part contains it too. Before each step the surface is divided anew, which keeps the balls
/// covering: a ball contains its power cell if all together cover the surface. The tilted ball itself is too far where
/// only a small part of a ball is exposed: a half-space would best contain a flat face.
class ConditionalGradient {
public:
    /// Both must outlive this.
    ConditionalGradient(const FineSurface& skin, const Occupancy& occupancy);

    /// Returns the best balls of at most `steps` steps, fewer if they bring no improvement. All of them cover the
    /// surface, whatever the given balls do. The volume is that of the balls and the solid together.
    CoverCandidate improved(Balls balls, int steps);

private:
    double claim(const Balls& balls);
    /// Returns the tilt of the surface exposed outside the solid, with EnclosingBall's signs.
    Vec3 tilt(const Balls& balls, std::size_t i);
    /// Sizes each ball to contain its part.
    void hold_parts(Balls& balls) const;
    Balls towards(const Balls& balls);
    /// Returns the best of `balls` and the points up to `share` of the way to `end`; sets the share it moved, or 0.
    CoverCandidate line_search(const CoverCandidate& balls, const Balls& end, double& share);

    const Occupancy& occupancy_;
    PowerCells cells_;
    Points inside_;
    double inside_volume_; ///< volume of the solid per point of inside_, units³
    EnclosingBall enclosing_ball_;
    Exposed exposed_;
    Owners owners_;
};

} // namespace foam::search::cover
