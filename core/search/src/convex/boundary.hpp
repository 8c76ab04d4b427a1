// The boundary of an element, in places.
#pragma once

#include "fit_programme.hpp"

#include <foam/geometry/vector.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace foam::inline search::convex {

/// Returns the area of the boundary, in square units.
inline double boundary_area(const Fit& fit) {
    using Kind = Element::Kind;
    constexpr double pi = std::numbers::pi;
    const Vec3& h = fit.half;
    const double r = fit.radius;
    return fit.kind == Kind::cylinder ? 2 * pi * r * (2 * h.z + r)
                                      : 8 * (h.x * h.y + h.y * h.z + h.z * h.x) + 4 * pi * r * (h.x + h.y + h.z + r);
}

/// Calls visit(point, normal, area) for points spread over the boundary, in the frame of the fit.
template <class Visit> void over_boundary(const Fit& fit, double area_each, Visit visit) {
    using Kind = Element::Kind;
    constexpr double pi = std::numbers::pi;
    const Vec3& h = fit.half;
    const double r = fit.radius;
    const auto parts = [](double length, double step) {
        return std::max(1, static_cast<int>(std::ceil(length / step)));
    };
    const double step = std::sqrt(area_each);
    const bool cylinder = fit.kind == Kind::cylinder;
    for (int a = 0; a < 3; ++a) {
        const int u = (a + 1) % 3, v = (a + 2) % 3;
        if (!cylinder && h[u] > 0 && h[v] > 0) { // two faces across the axis
            const int nu = parts(2 * h[u], step), nv = parts(2 * h[v], step);
            const double area = 4 * h[u] * h[v] / (nu * nv);
            for (int k = 0; k < 2 * nu * nv; ++k) {
                const double sign = k % 2 == 0 ? 1 : -1;
                const int i = k / 2 % nu, j = k / 2 / nu;
                Vec3 p, n{};
                p[a] = sign * (h[a] + r);
                p[u] = h[u] * ((2 * i + 1.0) / nu - 1);
                p[v] = h[v] * ((2 * j + 1.0) / nv - 1);
                n[a] = sign;
                visit(p, n, area);
            }
        }
        if (r > 0 && h[a] > 0 && (!cylinder || a == 2)) { // round edges along the axis
            const int along = parts(2 * h[a], step), around = 4 * parts(pi / 2 * r, step);
            const double area = 4 * pi * r * h[a] / (along * around);
            for (int k = 0; k < along * around; ++k) {
                const double angle = (k % around + 0.5) / around * 2 * pi;
                Vec3 n{}, p;
                n[u] = std::cos(angle);
                n[v] = std::sin(angle);
                p[u] = std::copysign(h[u], n[u]) + r * n[u];
                p[v] = std::copysign(h[v], n[v]) + r * n[v];
                p[a] = h[a] * ((2 * (k / around) + 1.0) / along - 1);
                visit(p, n, area);
            }
        }
    }
    if (cylinder) { // its ends
        const int count = std::max(8, static_cast<int>(pi * r * r / area_each));
        const double area = pi * r * r / count;
        for (int k = 0; k < count; ++k) {
            const double radius = r * std::sqrt((k + 0.5) / count), angle = k * (pi * (3 - std::sqrt(5.0)));
            for (const double sign : {1.0, -1.0}) {
                visit(Vec3{radius * std::cos(angle), radius * std::sin(angle), sign * h.z}, Vec3{0, 0, sign}, area);
            }
        }
    } else if (r > 0) { // corners
        const auto count = std::max<std::size_t>(32, static_cast<std::size_t>(4 * pi * r * r / area_each));
        const double area = 4 * pi * r * r / static_cast<double>(count);
        for (const Vec3& n : fibonacci_directions(count)) {
            visit(Vec3{std::copysign(h.x, n.x), std::copysign(h.y, n.y), std::copysign(h.z, n.z)} + n * r, n, area);
        }
    }
}

/// Returns how an integral over the outside changes with the variables of the fit, to first order: the sum of weight(p,
/// normal, area) times the way that each place of the boundary moves outwards. `p` and the normal are in the frame of
/// the cloud.
template <class Weight> Variables boundary_slopes(const Fit& fit, bool keep_axes, Weight weight) {
    constexpr double places = 400;
    Variables g = Variables::Zero();
    over_boundary(fit, boundary_area(fit) / places, [&](const Vec3& q, const Vec3& n, double area) {
        const Vec3 normal = fit.axes[0] * n.x + fit.axes[1] * n.y + fit.axes[2] * n.z;
        const double share = weight(fit.outside(q), normal, area);
        if (share == 0) {
            return;
        }
        const Vec3 turn = cross(q, n);
        for (int k = 0; k < 3; ++k) {
            g(k) += keep_axes ? 0 : share * turn[k];
            g(3 + k) += share * n[k];
            g(6 + k) += uses_half(fit.kind, k) ? share * std::abs(n[k]) : 0;
        }
        if (fit.kind != Element::Kind::box) {
            g(9) += fit.kind == Element::Kind::cylinder ? share * std::hypot(n.x, n.y) : share;
        }
    });
    return g;
}

} // namespace foam::inline search::convex
