// Two balls about a content that a plane cuts in two.
#pragma once

#include "by_spheres/moves/remainder.hpp"
#include "by_spheres/starts/enclosing_ball.hpp"

#include <climits>

namespace foam::inline search::by_spheres {

struct Plane {
    Vec3 normal{0, 0, 1};
    double offset = 0;
};

struct TwoBalls {
    std::array<Ball, 2> balls{}; ///< the first on the plane's positive side; on a side without content it has no radius
    double volume = 0;           ///< their excess volume, units³
    Plane plane;
};

/// Searches for the two balls of least volume that cover a content. Nearly always, the best ones are those of the two
/// parts at a plane, that of the circle in which the balls meet. So the search has three variables. Content that the
/// plane cuts counts for both sides; each ball then contains its part, as balls are convex: they cover by construction.
class TwoBallSearch {
public:
    /// `outside` has looked at the surroundings. Both must outlive this.
    TwoBallSearch(const Content& content, const OutsideVolume& outside);

    struct Plan {
        int directions, offsets; ///< planes that are tried first
        int kept;                ///< the best of these, which are refined
        int evaluations;         ///< of each plane
    };
    /// Searches from planes everywhere. Returns the best of each direction, the best of all first. Precondition: the
    /// content has points.
    std::vector<TwoBalls> anywhere(const Plan& plan);
    /// Refines the first of these.
    TwoBalls improved(const std::vector<TwoBalls>& starts, const Plan& plan);
    /// Refines two existing balls; the result is never worse.
    TwoBalls near(const std::array<Ball, 2>& balls, int evaluations);

private:
    TwoBalls at(const Plane& plane);
    /// Minimises by a downhill simplex (Nelder and Mead 1965) over the plane's turns about its middle and its shift.
    /// After `patience` evaluations it stops unless the volume is less than `enough`.
    TwoBalls descend(const Plane& start, double turn, double shift, int evaluations, int patience = INT_MAX,
                     double enough = 0);
    void set_tilts(const std::array<Ball, 2>& balls);

    const Content& content_;
    const OutsideVolume& outside_;
    EnclosingBall enclosing_ball_;
    std::vector<float> height_;
    std::array<Points, 2> half_; ///< buffers for the points of each side
    std::array<Vec3, 2> tilts_{}, centers_{};
};

} // namespace foam::search::by_spheres
