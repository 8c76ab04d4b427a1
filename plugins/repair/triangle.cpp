#include "soup.hpp"

namespace foam::repair {

bool is_degenerate(const Corners& t) {
    const Vec3 ab = t[1] - t[0], bc = t[2] - t[1], ca = t[0] - t[2];
    const double longest = std::max({squared_norm(ab), squared_norm(bc), squared_norm(ca)});
    return !(norm(cross(ab, ca)) > 1e-12 * longest);
}

Vec3 closest_point(const Corners& t, const Vec3& p) {
    const Vec3& a = t[0];
    const Vec3 ab = t[1] - a, ac = t[2] - a, ap = p - a;
    const double d1 = dot(ab, ap), d2 = dot(ac, ap);
    if (d1 <= 0 && d2 <= 0) {
        return a;
    }
    const Vec3 bp = p - t[1];
    const double d3 = dot(ab, bp), d4 = dot(ac, bp);
    if (d3 >= 0 && d4 <= d3) {
        return t[1];
    }
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) {
        return a + ab * (d1 / (d1 - d3));
    }
    const Vec3 cp = p - t[2];
    const double d5 = dot(ab, cp), d6 = dot(ac, cp);
    if (d6 >= 0 && d5 <= d6) {
        return t[2];
    }
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) {
        return a + ac * (d2 / (d2 - d6));
    }
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
        return t[1] + (t[2] - t[1]) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    const double scale = 1 / (va + vb + vc);
    return a + ab * (vb * scale) + ac * (vc * scale);
}

bool overlaps_cube(const Corners& t, const Vec3& center, double half_size) {
    const double h = half_size;
    const Corners v = {t[0] - center, t[1] - center, t[2] - center};
    for (int axis = 0; axis < 3; ++axis) {
        if (std::min({v[0][axis], v[1][axis], v[2][axis]}) > h || std::max({v[0][axis], v[1][axis], v[2][axis]}) < -h) {
            return false;
        }
    }
    const std::array<Vec3, 3> edges = {v[1] - v[0], v[2] - v[1], v[0] - v[2]};
    const Vec3 normal = cross(edges[0], edges[1]);
    if (std::abs(dot(normal, v[0])) > h * (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z))) {
        return false;
    }
    for (const Vec3& e : edges) {
        for (const Vec3& axis : {Vec3{0, -e.z, e.y}, Vec3{e.z, 0, -e.x}, Vec3{-e.y, e.x, 0}}) {
            const double a = dot(axis, v[0]), b = dot(axis, v[1]), c = dot(axis, v[2]);
            const double reach = h * (std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z));
            if (std::min({a, b, c}) > reach || std::max({a, b, c}) < -reach) {
                return false;
            }
        }
    }
    return true;
}

bool crosses(const Corners& t, const Vec3& a, const Vec3& b) {
    const Vec3 normal = area_vector(t);
    const double side_a = dot(normal, a - t[0]), side_b = dot(normal, b - t[0]);
    if ((side_a > 0 && side_b > 0) || (side_a < 0 && side_b < 0) || side_a == side_b) {
        return false;
    }
    // Volumes of the tetrahedra of the segment and the edges: of one sign if it passes inside of all three.
    const Vec3 direction = b - a;
    const double u = dot(direction, cross(t[0] - a, t[1] - a));
    const double v = dot(direction, cross(t[1] - a, t[2] - a));
    const double w = dot(direction, cross(t[2] - a, t[0] - a));
    return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

double solid_angle(const Corners& t, const Vec3& p) {
    const Vec3 a = t[0] - p, b = t[1] - p, c = t[2] - p;
    const double la = norm(a), lb = norm(b), lc = norm(c);
    return 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

} // namespace foam::repair
