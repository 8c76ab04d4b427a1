// Intersections of a line with triangles: watertight (Woop, Benthin, Wald 2013) and consistent at edges and vertices.
#pragma once

#include <foam/geometry/internal/triangles.hpp>

#include <array>

namespace foam::inline geometry {

/// An intersection of a line with a surface, and the change of the winding number there.
struct Crossing {
    double t;
    int change; ///< +1 entering, -1 leaving

    /// Orders along the line. Entering comes first: parts that touch become one.
    bool operator<(const Crossing& other) const { return t != other.t ? t < other.t : change > other.change; }
};

/// The line origin + t · direction, prepared: axes permuted so that the direction's largest component comes last, and
/// sheared so that the line is the last axis. A vertex is mapped independently of its triangle, so it is the same in
/// all of them.
class Line {
public:
    /// Precondition: direction is finite and not zero.
    Line(const Vec3& origin, const Vec3& direction) : origin_(origin), direction_(direction) {
        const Vec3 d{std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)};
        kz_ = d.x >= d.y && d.x >= d.z ? 0 : d.y >= d.z ? 1 : 2;
        kx_ = (kz_ + 1) % 3;
        ky_ = (kz_ + 2) % 3;
        if (direction[kz_] < 0) {
            std::swap(kx_, ky_); // keeps counter-clockwise triangles counter-clockwise
        }
        sz_ = 1 / direction[kz_];
        sx_ = direction[kx_] * sz_;
        sy_ = direction[ky_] * sz_;
    }

    /// Returns +1 where the line enters through the triangle's front, -1 where it leaves, 0 if it misses it. Sets `t`
    /// if it hits.
    int cross(const Corners& triangle, double& t) const {
        const Flat a = flat(triangle.a), b = flat(triangle.b), c = flat(triangle.c);
        const Edge bc(b, c), ca(c, a), ab(a, b);
        if (bc.sign == 0 || bc.sign != ca.sign || ca.sign != ab.sign) {
            return 0;
        }
        const double det = bc.value + ca.value + ab.value;
        if (det == 0) {
            return 0;
        }
        t = (bc.value * a.z + ca.value * b.z + ab.value * c.z) / det * sz_;
        return -bc.sign;
    }

    const Vec3& origin() const { return origin_; }
    const Vec3& direction() const { return direction_; }
    int axis() const { return kz_; }
    /// Returns whether the line is parallel to an axis.
    bool axis_aligned() const { return sx_ == 0 && sy_ == 0; }

private:
    struct Flat {
        double x, y, z;
    };
    Flat flat(const Vec3& v) const {
        const double z = v[kz_] - origin_[kz_];
        return {v[kx_] - origin_[kx_] - sx_ * z, v[ky_] - origin_[ky_] - sy_ * z, z};
    }

    /// The side of an edge on which the line passes. If the line meets the edge, the side is that of the line moved by
    /// (ε, ε²), an infinitesimal shift (Edelsbrunner and Mücke 1990), so that exactly the right triangles around an
    /// edge or vertex are hit. It is exactly antisymmetric in p and q: both triangles at an edge agree.
    struct Edge {
        Edge(const Flat& p, const Flat& q) : value(p.x * q.y - p.y * q.x) {
            sign = value > 0 ? 1 : value < 0 ? -1 : 0;
            if (sign == 0) {
                sign = p.y > q.y ? 1 : p.y < q.y ? -1 : q.x > p.x ? 1 : q.x < p.x ? -1 : 0;
            }
        }
        double value;
        int sign;
    };

    Vec3 origin_, direction_;
    int kx_, ky_, kz_;
    double sx_, sy_, sz_;
};

} // namespace foam::geometry
