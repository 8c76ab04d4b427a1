// The quadric error of Garland, Heckbert: Surface Simplification Using Quadric Error Metrics, SIGGRAPH 1997, section 3.
#pragma once

#include <foam/geometry/vector.hpp>

namespace foam::simplify {

/// Q(x) = xᵀ A x + 2 bᵀ x + c: the weighted sum of squared distances to planes.
class Quadric {
public:
    /// Returns weight · (n·x + d)² for the plane through `point` with the unit normal n.
    static Quadric plane(const Vec3& point, const Vec3& normal, double weight);

    Quadric& operator+=(const Quadric& other) {
        xx_ += other.xx_;
        xy_ += other.xy_;
        xz_ += other.xz_;
        yy_ += other.yy_;
        yz_ += other.yz_;
        zz_ += other.zz_;
        b_ += other.b_;
        c_ += other.c_;
        return *this;
    }
    double error(const Vec3& x) const;
    /// Returns the point of least error. In directions that the planes do not determine, the one nearest to `near`.
    Vec3 minimizer(const Vec3& near) const;

private:
    Vec3 times(const Vec3& x) const;

    double xx_ = 0, xy_ = 0, xz_ = 0, yy_ = 0, yz_ = 0, zz_ = 0;
    Vec3 b_;
    double c_ = 0;
};

} // namespace foam::simplify
