// The smallest ball around points, and the ball that pays best where moving it pays too.
#pragma once

#include "cover/points.hpp"

#include <array>

namespace foam::cover {

/// F / A of a ball that shows the area A, F the integral of the normal over it; no longer than `longest`. Zero where
/// nothing shows.
inline Vec3 tilt_of(const Vec3& force, double area, double longest) {
    if (!(area > 0)) {
        return {};
    }
    const Vec3 tilt = force / area;
    const double length = norm(tilt);
    return length > longest ? tilt * (longest / length) : tilt;
}

/// The ball that holds the points and has the least radius + tilt · centre, |tilt| < 1. Without tilt it is the smallest
/// enclosing ball. With A the area of a ball's surface that shows and F the integral of the normal over it, A · radius
/// + F · centre is to first order the volume that a ball adds to a union: tilt F / A. Like the smallest enclosing ball
/// it is a problem of linear-programming type (Sharir and Welzl 1992) with bases of at most four points: the farthest
/// point outside enters the basis (the pivot rule of Gärtner 1999) until there is none.
class EnclosingBall {
public:
    /// Of the first `count` points; of none: a ball without radius. `near`: about where it is. It holds the points to a
    /// few parts in a million.
    Ball of(const Points& points, std::size_t count, const Vec3& tilt, const Vec3& near);

private:
    struct Solution {
        Vec3 center{};
        double radius = 0, cost = 0;
    };
    void enter(const Vec3& point, const Vec3& tilt);
    template <int axes> void descend(const Vec3& offset, const Vec3& tilt, std::uint32_t chosen, std::size_t first);
    bool holds_rest(const Solution& s, std::uint32_t chosen) const;

    std::array<Vec3, 4> basis_{};
    std::size_t size_ = 0;
    // While the pivot enters:
    Vec3 pivot_{}, tilt_{};
    Vec3 axis_[3]{};     ///< of the affine hull of the pivot and the chosen points
    double length_[3]{}; ///< of the offset along them
    Solution best_;
    std::uint32_t best_chosen_ = 0;
    bool found_ = false;
};

struct Farthest {
    std::size_t index = 0;
    float squared = 0; ///< distance
};
/// Of the first `count` points, at least one, the one farthest from a place.
Farthest farthest(const Points& points, std::size_t count, const Vec3& from);

} // namespace foam::cover
