// Two balls about a content that a plane cuts in two.
#pragma once

#include "cover/enclosing_ball.hpp"
#include "cover/outside_volume.hpp"
#include "cover/remainder.hpp"

#include <climits>

namespace foam::cover {

struct Plane {
    Vec3 normal{0, 0, 1};
    double offset = 0;
};

struct TwoBalls {
    std::array<Ball, 2> balls{}; ///< the first on the plane's positive side; of a side without content: no radius
    double volume = 0;           ///< that they claim outside, units³
    Plane plane;
};

/// Of the covers of a content by two balls the best are, but for little, those of the two parts that a plane leaves:
/// the plane of the circle in which the balls meet. So three numbers are looked for. What the plane cuts counts for
/// both sides; each ball then holds its part, as balls are convex: covers by construction.
class TwoBallSearch {
public:
    /// `outside` has looked at the surroundings. Both must outlive this.
    TwoBallSearch(const Content& content, const OutsideVolume& outside);

    struct Plan {
        int directions, offsets; ///< planes that are tried first
        int kept;                ///< the best of them that are gone on with
        int evaluations;         ///< of each
    };
    /// From planes all over, the best of each direction, the best of all first. Precondition: the content has points.
    std::vector<TwoBalls> anywhere(const Plan& plan);
    /// Gone on with from the first of these.
    TwoBalls improved(const std::vector<TwoBalls>& starts, const Plan& plan);
    /// From two balls as they are: never worse than these.
    TwoBalls near(const std::array<Ball, 2>& balls, int evaluations);

private:
    TwoBalls at(const Plane& plane);
    /// A downhill simplex (Nelder and Mead 1965) of the plane's turns about its middle and its shift; after `patience`
    /// evaluations it is given up unless it claims less than `enough`.
    TwoBalls descend(const Plane& start, double turn, double shift, int evaluations, int patience = INT_MAX,
                     double enough = 0);
    void set_tilts(const std::array<Ball, 2>& balls);

    const Content& content_;
    const OutsideVolume& outside_;
    EnclosingBall enclosing_ball_;
    std::vector<float> height_;
    std::array<Points, 2> half_; ///< room for the points of each side
    std::array<Vec3, 2> tilts_{}, centers_{};
};

} // namespace foam::cover
