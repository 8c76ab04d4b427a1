#include <foam/geometry/internal/triangles.hpp>

#include <numbers>

namespace foam::inline geometry {
namespace {

Vec3 closest_on_segment(const Vec3& a, const Vec3& b, const Vec3& p) {
    const Vec3 ab = b - a;
    const double length2 = squared_norm(ab);
    if (!(length2 > 0)) {
        return a;
    }
    return a + ab * std::clamp(dot(p - a, ab) / length2, 0.0, 1.0);
}

/// Returns the nearest point on the three sides, for triangles without area.
Vec3 closest_on_sides(const Corners& t, const Vec3& p) {
    Vec3 best = closest_on_segment(t.a, t.b, p);
    for (const Vec3& q : {closest_on_segment(t.b, t.c, p), closest_on_segment(t.c, t.a, p)}) {
        if (squared_norm(q - p) < squared_norm(best - p)) {
            best = q;
        }
    }
    return best;
}

} // namespace

Vec3 closest_on_triangle(const Corners& t, const Vec3& p) {
    const Vec3 ab = t.b - t.a, ac = t.c - t.a, ap = p - t.a;
    const double d1 = dot(ab, ap), d2 = dot(ac, ap);
    if (d1 <= 0 && d2 <= 0) {
        return t.a;
    }
    const Vec3 bp = p - t.b;
    const double d3 = dot(ab, bp), d4 = dot(ac, bp);
    if (d3 >= 0 && d4 <= d3) {
        return t.b;
    }
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0 && d1 > d3) {
        return t.a + ab * (d1 / (d1 - d3));
    }
    const Vec3 cp = p - t.c;
    const double d5 = dot(ab, cp), d6 = dot(ac, cp);
    if (d6 >= 0 && d5 <= d6) {
        return t.c;
    }
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0 && d2 > d6) {
        return t.a + ac * (d2 / (d2 - d6));
    }
    const double va = d3 * d6 - d5 * d4;
    const double towards_c = d4 - d3, towards_b = d5 - d6;
    if (va <= 0 && towards_c >= 0 && towards_b >= 0 && towards_c + towards_b > 0) {
        return t.b + (t.c - t.b) * (towards_c / (towards_c + towards_b));
    }
    const double sum = va + vb + vc;
    // A needle's barycentric coordinates are noise: their sum is below the rounding of the products behind them.
    if (!(sum > 1e-14 * squared_norm(ab) * squared_norm(ac))) {
        return closest_on_sides(t, p);
    }
    return t.a + ab * (vb / sum) + ac * (vc / sum);
}

double winding_of_triangle(const Corners& t, const Vec3& p) {
    const Vec3 a = t.a - p, b = t.b - p, c = t.c - p;
    const double la = norm(a), lb = norm(b), lc = norm(c);
    const double numerator = dot(a, cross(b, c));
    const double denominator = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    if (numerator == 0) {
        return 0; // in the triangle's plane: by symmetry neither side
    }
    return std::atan2(numerator, denominator) / (2 * std::numbers::pi);
}

} // namespace foam::geometry
