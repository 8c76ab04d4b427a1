// Where three balls meet and no way leads up: the only places where a cavity between balls can have its topmost point.
#pragma once

#include <foam/geometry/vector.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace foam::inline geometry {

/// A topmost point of the space outside of balls, as far as is seen near it.
struct BallTop {
    Vec3 point;
    double error; ///< it lies this near
};

/// Finds tops of the space outside of balls. docs/dev/certificate.md has the argument.
class BallTops {
public:
    /// `up`: unit. Balls of radius 0 count as absent.
    BallTops(std::vector<Vec3> centers, std::vector<double> radii, const Vec3& up);

    /// Sets `tops` to all those where ball `i` meets two later ones. Returns false if rounding leaves them in doubt.
    /// O(n³) in the balls that meet it, few of which are left after the first two loops.
    bool of(std::uint32_t i, std::vector<BallTop>& tops);

private:
    struct Circle {
        std::uint32_t i, j;
        Vec3 middle, axis;
        double radius;
    };

    bool find_near(std::uint32_t i);
    /// Returns whether the circle is held by a ball; else sets crossed_.
    bool find_crossed(const Circle& circle);
    bool add_tops(const Circle& circle, std::uint32_t k, std::vector<BallTop>& tops) const;
    bool add_top(const Circle& circle, std::uint32_t k, const Vec3& p, double error, std::vector<BallTop>& tops) const;

    std::vector<Vec3> centers_;
    std::vector<double> radii_;
    Vec3 up_;
    double squared_error_ = 0; ///< of sums of squared lengths
    std::vector<std::uint32_t> near_, crossed_;
};

} // namespace foam::inline geometry
