// Sums of solid angles of triangles, with one arc tangent for many of them.
#pragma once

#include <foam/geometry/internal/triangle.hpp>

#include <cmath>
#include <numbers>

namespace foam::inline geometry {

/// Half the solid angle of a triangle seen from `p`, as the angle of re + i·im (van Oosterom and Strackee 1983,
/// equation 8).
struct HalfSolidAngle {
    HalfSolidAngle(const Corners& t, const Vec3& p) {
        const Vec3 a = t.a - p, b = t.b - p, c = t.c - p;
        const double la = norm(a), lb = norm(b), lc = norm(c);
        scale = la * lb * lc;
        re = scale + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
        im = dot(a, cross(b, c)); // 0 in the triangle's plane: by symmetry neither side
    }
    /// Returns whether `p` is so near that rounding decides its side. The solid angle is then 2π in the triangle, π on
    /// its edges.
    bool on_triangle() const { return std::abs(im) <= 1e-9 * scale && re <= 1e-9 * scale; }

    double re, im, scale;
};

/// The sum of angles between -π and π, each given as that of a complex number. It is the angle of their product, plus
/// the whole turns counted where the product passes the negative real axis.
class AngleSum {
public:
    void add(const HalfSolidAngle& angle) {
        const double re = angle.re, im = angle.im;
        if (im == 0) {
            return;
        }
        const double scale = 1 / (std::abs(re) + std::abs(im));
        const double x = (x_ * re - y_ * im) * scale, y = (x_ * im + y_ * re) * scale + 0.0; // -0 becomes 0
        turns_ += y_ >= 0 && im > 0 && y < 0 ? 1 : y_ < 0 && im < 0 && y >= 0 ? -1 : 0;
        x_ = x;
        y_ = y;
        if (std::abs(x) + std::abs(y) < 1e-100) { // each factor is between 1/√2 and 1
            x_ *= 1e100;
            y_ *= 1e100;
        }
    }
    double value() const { return std::atan2(y_, x_) + 2 * std::numbers::pi * turns_; }

private:
    double x_ = 1, y_ = 0;
    int turns_ = 0;
};

} // namespace foam::geometry
