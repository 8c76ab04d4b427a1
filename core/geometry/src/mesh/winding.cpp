// Fast winding numbers (Barill, Dickson, Schmidt, Levin, Jacobson 2018): distant clusters of triangles contribute
// through the Taylor expansion of the dipole field about their centre, to the third order (their equations 7 to 9).
#include "mesh/mesh_part.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/geometry/internal/triangles.hpp>

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

namespace {

/// Number of its radii beyond which a cluster counts as distant. The truncation error is of the order of far_factor^-3
/// of the cluster's share: the winding number is then right to about 1e-3.
constexpr double far_factor = 2.5;

/// Returns the cubic form (a·r) q(r) of a linear form and a quadratic one (xx, yy, zz, xy, yz, zx), laid out as
/// Moments::third.
std::array<double, 10> product(const Vec3& a, const std::array<double, 6>& q) {
    return {a.x * q[0],
            a.y * q[1],
            a.z * q[2],
            a.x * q[3] + a.y * q[0],
            a.x * q[5] + a.z * q[0],
            a.x * q[1] + a.y * q[3],
            a.y * q[4] + a.z * q[1],
            a.x * q[2] + a.z * q[5],
            a.y * q[2] + a.z * q[4],
            a.x * q[4] + a.y * q[5] + a.z * q[3]};
}

} // namespace

void MeshPart::Moments::add(const Corners& corners) {
    const Vec3 a = corners.a - center, b = corners.b - center, c = corners.c - center;
    const Vec3 n = cross(b - a, c - a) * 0.5; // ∫ n
    const Vec3 s = a + b + c, y = s / 3;      // y: the centroid
    normal += n;
    trace += dot(n, y);
    const std::array<double, 6> linear{
        n.x * y.x, n.y * y.y, n.z * y.z, n.x * y.y + n.y * y.x, n.y * y.z + n.z * y.y, n.z * y.x + n.x * y.z};
    for (std::size_t k = 0; k < 6; ++k) {
        second[k] += linear[k];
    }
    // Mean of y_j y_k over a triangle: (Σ corners' products + product of the corners' sum) / 12.
    const auto mean = [&](int j, int k) { return (a[j] * a[k] + b[j] * b[k] + c[j] * c[k] + s[j] * s[k]) / 12; };
    const double xx = mean(0, 0), yy = mean(1, 1), zz = mean(2, 2), xy = mean(0, 1), yz = mean(1, 2), zx = mean(2, 0);
    third_trace +=
        2 * Vec3{n.x * xx + n.y * xy + n.z * zx, n.x * xy + n.y * yy + n.z * yz, n.x * zx + n.y * yz + n.z * zz} +
        n * (xx + yy + zz);
    const std::array<double, 10> cubic{n.x * xx,
                                       n.y * yy,
                                       n.z * zz,
                                       2 * n.x * xy + n.y * xx,
                                       2 * n.x * zx + n.z * xx,
                                       2 * n.y * xy + n.x * yy,
                                       2 * n.y * yz + n.z * yy,
                                       2 * n.z * zx + n.x * zz,
                                       2 * n.z * yz + n.y * zz,
                                       2 * (n.x * yz + n.y * zx + n.z * xy)};
    for (std::size_t k = 0; k < 10; ++k) {
        third[k] += cubic[k];
    }
}

/// Adds the moments of `other`. With the other centre at s from this one, y becomes y + s in every integral; the
/// products are multiplied out.
void MeshPart::Moments::add(const Moments& other) {
    const Vec3 s = other.center - center;
    const Vec3& n = other.normal;
    const std::array<double, 6>& q = other.second;
    normal += n;
    trace += other.trace + dot(n, s);
    const std::array<double, 6> linear{
        n.x * s.x, n.y * s.y, n.z * s.z, n.x * s.y + n.y * s.x, n.y * s.z + n.z * s.y, n.z * s.x + n.x * s.z};
    for (std::size_t k = 0; k < 6; ++k) {
        second[k] += q[k] + linear[k];
    }
    const Vec3 across{2 * q[0] * s.x + q[3] * s.y + q[5] * s.z, // ∫ (n·s) y + n (y·s)
                      q[3] * s.x + 2 * q[1] * s.y + q[4] * s.z, q[5] * s.x + q[4] * s.y + 2 * q[2] * s.z};
    third_trace += other.third_trace + 2 * other.trace * s + 2 * across + 2 * dot(n, s) * s + n * squared_norm(s);
    const std::array<double, 10> once = product(s, q);
    const std::array<double, 10> twice =
        product(n, {s.x * s.x, s.y * s.y, s.z * s.z, 2 * s.x * s.y, 2 * s.y * s.z, 2 * s.z * s.x});
    for (std::size_t k = 0; k < 10; ++k) {
        third[k] += other.third[k] + 2 * once[k] + twice[k];
    }
}

/// Returns 4π times the winding number. r: from the point to the centre. With f(x) = x/|x|³:
/// ∫ n·f(r + y) = n·f + ∂f : ∫ n y + 1/2 ∂²f : ∫ n y y.
double MeshPart::Moments::winding(const Vec3& r, double r2) const {
    const double quadratic = second[0] * r.x * r.x + second[1] * r.y * r.y + second[2] * r.z * r.z +
                             second[3] * r.x * r.y + second[4] * r.y * r.z + second[5] * r.z * r.x;
    const double cubic = r.x * (r.x * (third[0] * r.x + third[3] * r.y + third[4] * r.z) + third[9] * r.y * r.z) +
                         r.y * (r.y * (third[1] * r.y + third[5] * r.x + third[6] * r.z)) +
                         r.z * (r.z * (third[2] * r.z + third[7] * r.x + third[8] * r.y));
    const double inverse2 = 1 / r2;
    return (dot(normal, r) + trace - 3 * quadratic * inverse2 -
            1.5 * inverse2 * (dot(third_trace, r) - 5 * cubic * inverse2)) *
           inverse2 * std::sqrt(inverse2);
}

/// Returns the radius about `center` of the items that count; negative if there is none.
double MeshPart::radius_about(const Vec3& center, std::uint32_t begin, std::uint32_t end) const {
    double squared = -1;
    Corners scratch;
    for (std::uint32_t i = begin; i < end; ++i) {
        if (counts(i)) {
            const auto& [a, b, c] = corners(i, scratch);
            squared = std::max({squared, squared_norm(a - center), squared_norm(b - center), squared_norm(c - center)});
        }
    }
    return squared < 0 ? -1 : std::sqrt(squared);
}

const std::vector<MeshPart::Moments>& MeshPart::moments() const {
    if (!closed_) {
        std::call_once(moments_once_, [&] { moments_ = computed_moments(); });
    }
    return moments_;
}

/// Computes the moments of leaves from their triangles, of other nodes from their children.
std::vector<MeshPart::Moments> MeshPart::computed_moments() const {
    struct Below {
        std::uint32_t begin, end; // items
        double area = 0;          // twice that of the items that count
    };
    const std::vector<BvhNode>& nodes = bvh_.nodes();
    std::vector<Moments> result(nodes.size());
    Corners scratch;
    std::vector<Below> below(nodes.size());
    CancellationCounter asking(1024);
    for (std::size_t n = nodes.size(); n-- > 0;) { // children come after their parents
        asking.check();
        const BvhNode& node = nodes[n];
        Moments& moments = result[n];
        const Vec3 middle = (node.low + node.high) * 0.5;
        Vec3 sum{}; // of centroids about the middle, weighted by area
        if (node.leaf()) {
            below[n] = {node.first, node.first + node.count};
            for (std::uint32_t i = below[n].begin; i < below[n].end; ++i) {
                const auto& [a, b, c] = corners(i, scratch);
                const double area = counts(i) ? norm(cross(b - a, c - a)) : 0;
                below[n].area += area;
                sum += ((a - middle) + (b - middle) + (c - middle)) * (area / 3);
            }
        } else {
            below[n] = {below[node.first].begin, below[node.first + 1].end};
            for (const std::uint32_t child : {node.first, node.first + 1}) {
                below[n].area += below[child].area;
                sum += (result[child].center - middle) * below[child].area;
            }
        }
        moments.area = below[n].area / 2;
        moments.center = below[n].area > 0 ? middle + sum / below[n].area : middle;
        moments.radius = radius_about(moments.center, below[n].begin, below[n].end);
        if (!node.leaf()) {
            moments.add(result[node.first]);
            moments.add(result[node.first + 1]);
            continue;
        }
        for (std::uint32_t i = below[n].begin; i < below[n].end; ++i) {
            if (counts(i)) {
                moments.add(corners(i, scratch));
            }
        }
    }
    return result;
}

/// Calls far(moments, r, r²) for the distant clusters, r being the vector to their centre, and near(node) for the
/// leaves that are not distant, until one call returns false.
template <class Far, class Near> void MeshPart::visit_clusters(const Vec3& p, Far far, Near near) const {
    const std::vector<BvhNode>& nodes = bvh_.nodes();
    const std::vector<Moments>& moments = this->moments();
    std::array<std::uint32_t, Bvh::max_depth> stack;
    std::size_t size = 0;
    stack[size] = 0;
    size += !nodes.empty();
    while (size > 0) {
        const std::uint32_t n = stack[--size];
        if (!moments.empty()) {
            const Moments& m = moments[n];
            const Vec3 r = m.center - p;
            const double r2 = squared_norm(r);
            if (m.radius < 0) {
                continue;
            }
            if (r2 > far_factor * far_factor * m.radius * m.radius) {
                if (!far(m, r, r2)) {
                    return;
                }
                continue;
            }
        }
        if (!nodes[n].leaf()) {
            stack[size++] = nodes[n].first + 1;
            stack[size++] = nodes[n].first;
        } else if (!near(nodes[n])) {
            return;
        }
    }
}

MeshPart::Winding MeshPart::winding_by_expansion(const Vec3& p) const {
    AngleSum near; // half the solid angles
    double far = 0;
    bool on_triangle = false;
    Corners scratch;
    visit_clusters(
        p,
        [&](const Moments& m, const Vec3& r, double r2) {
            far += m.winding(r, r2);
            return true;
        },
        [&](const BvhNode& leaf) {
            for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
                if (counts(i)) {
                    const HalfSolidAngle angle(corners(i, scratch), p);
                    on_triangle = on_triangle || angle.on_triangle();
                    near.add(angle);
                }
            }
            return true;
        });
    return {near.value() / (2 * std::numbers::pi) + far / (4 * std::numbers::pi), on_triangle};
}

/// Returns a bound: a dipole's field changes by at most 2/d³ per unit of length, d being the distance.
MeshPart::Variation MeshPart::winding_around(const Vec3& center, double radius, double most) const {
    AngleSum near;
    double far = 0, variation = 0;
    Corners scratch;
    const auto add_variation = [&](double area, double distance) {
        const double d = distance - radius;
        variation += d > 0 ? area * radius / (2 * std::numbers::pi * d * d * d) : most;
        return variation < most;
    };
    visit_clusters(
        center,
        [&](const Moments& m, const Vec3& r, double r2) {
            far += m.winding(r, r2);
            return add_variation(m.area, std::sqrt(r2) - m.radius);
        },
        [&](const BvhNode& leaf) {
            for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
                if (counts(i)) {
                    const Corners& t = corners(i, scratch);
                    near.add(HalfSolidAngle(t, center));
                    const double area = norm(cross(t.b - t.a, t.c - t.a)) / 2;
                    if (!add_variation(area, distance(closest_on_triangle(t, center), center))) {
                        return false;
                    }
                }
            }
            return true;
        });
    return {near.value() / (2 * std::numbers::pi) + far / (4 * std::numbers::pi), variation};
}

} // namespace foam::inline geometry
