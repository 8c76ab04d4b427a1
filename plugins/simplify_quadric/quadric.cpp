#include "quadric.hpp"

namespace foam::simplify {

Quadric Quadric::plane(const Vec3& point, const Vec3& n, double weight) {
    const double d = -dot(n, point);
    Quadric q;
    q.xx_ = weight * n.x * n.x;
    q.xy_ = weight * n.x * n.y;
    q.xz_ = weight * n.x * n.z;
    q.yy_ = weight * n.y * n.y;
    q.yz_ = weight * n.y * n.z;
    q.zz_ = weight * n.z * n.z;
    q.b_ = n * (weight * d);
    q.c_ = weight * d * d;
    return q;
}

Vec3 Quadric::times(const Vec3& x) const {
    return {xx_ * x.x + xy_ * x.y + xz_ * x.z, xy_ * x.x + yy_ * x.y + yz_ * x.z, xz_ * x.x + yz_ * x.y + zz_ * x.z};
}

double Quadric::error(const Vec3& x) const {
    return std::max(0.0, dot(x, times(x)) + 2 * dot(b_, x) + c_);
}

Vec3 Quadric::minimizer(const Vec3& near) const {
    // (A + r I) s = -(A near + b) for the step s from `near`. The small r makes the matrix regular (Tikhonov):
    // directions that the planes do not determine get no step.
    const double r = 1e-4 * (xx_ + yy_ + zz_);
    if (!(r > 0)) {
        return near;
    }
    const Vec3 row0 = {xx_ + r, xy_, xz_}, row1 = {xy_, yy_ + r, yz_}, row2 = {xz_, yz_, zz_ + r};
    const Vec3 c0 = cross(row1, row2), c1 = cross(row2, row0), c2 = cross(row0, row1);
    const double determinant = dot(row0, c0);
    const Vec3 g = -(times(near) + b_);
    return near + (c0 * g.x + c1 * g.y + c2 * g.z) / determinant;
}

} // namespace foam::simplify
