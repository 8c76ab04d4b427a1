// The smallest ball around points, and its tilted variant.
#pragma once

#include "by_spheres/measured/points.hpp"

#include <array>

namespace foam::inline search::by_spheres {

/// Returns F / A for a ball with exposed area A, F the integral of the normal over it; at most `longest` long. Zero
/// where nothing is exposed.
inline Vec3 tilt_of(const Vec3& force, double area, double longest) {
    if (!(area > 0)) {
        return {};
    }
    const Vec3 tilt = force / area;
    const double length = norm(tilt);
    return length > longest ? tilt * (longest / length) : tilt;
}

/// The ball that contains the points and has the least radius + tilt · centre, |tilt| < 1. Without tilt it is the
/// smallest enclosing ball. With A the exposed area of a ball and F the integral of the normal over it, A · radius + F
/// · centre is to first order the volume that a ball adds to a union: the tilt is F / A. Like the smallest enclosing
/// ball it is a problem of linear-programming type (Sharir and Welzl 1992) with bases of at most four points: the
/// farthest point outside enters the basis (the pivot rule of Gärtner 1999) until there is none.
class EnclosingBall {
public:
    /// Returns the ball of the first `count` points; without points, a ball without radius. `near`: an estimate of the
    /// result. The ball contains the points to a few millionths.
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
    // State while the pivot enters:
    Vec3 pivot_{}, tilt_{};
    Vec3 axis_[3]{};     ///< axes of the affine hull of the pivot and the chosen points
    double length_[3]{}; ///< lengths of the offset along them
    Solution best_;
    std::uint32_t best_chosen_ = 0;
    bool found_ = false;
};

struct Farthest {
    std::size_t index = 0;
    float squared = 0; ///< squared distance
};
/// Returns the farthest of the first `count` points, at least one, from a place.
Farthest farthest(const Points& points, std::size_t count, const Vec3& from);

} // namespace foam::search::by_spheres
