// A fit as the variables of a programme: the volume is to fall, and points are to stay inside; its steps and its descent.
#pragma once

#include "cloud.hpp"
#include "ellipsoid_fit.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/hypot.hpp>
#include <foam/geometry/vector.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace foam::inline search::convex {

constexpr int most_variables = 10;
using Variables = Eigen::Matrix<double, most_variables, 1>;

/// slope · step <= room
struct Constraint {
    Variables slope;
    double room;
};

/// Returns the step s with the least gradient · s + |s|² damping / 2 that keeps the constraints; zero where none keeps
/// them. The dual method of Goldfarb and Idnani (1983): the most violated constraint becomes active until none is
/// violated.
Variables quadratic_step(const Variables& gradient, double damping, const std::vector<Constraint>& constraints);

// The variables: a rotation vector (3, in the frame of the fit), centre (3, in that frame), half lengths (3), radius.
// Where a kind does not use one, its slopes are 0.

/// Returns whether a fit of the kind has a length along an axis of its own.
bool uses_half(Element::Kind kind, int axis);
/// Returns the vector from the nearest point of the core of a fit, in the frame of the fit.
Vec3 from_core(const Fit& fit, const Vec3& local);
/// Makes the lengths of a fit the least that hold the points, about its core: its radius, the half length of a cylinder
/// and those of a box.
void close_around(Fit& fit, const Cloud& cloud);
/// Returns the points within a distance of the boundary of a fit that holds all, in its frame: what a small change of
/// the fit depends on.
Cloud near_boundary(const Fit& fit, const Cloud& cloud, double distance);
/// Writes the constraints of lengths, and of points that a step may reach, to first order. `length`: at most that of
/// the variables of the step. `keep_axes`: a step does not turn the fit.
void set_constraints(const Fit& fit, const Cloud& cloud, double length, std::vector<Constraint>& constraints,
                     bool keep_axes);
/// Returns the fit after a step, with the lengths that hold the points.
Fit stepped(const Fit& fit, const Variables& step, const Cloud& cloud);

/// Returns the volume's slopes. Not for boxes and spheres.
Variables volume_slopes(const Fit& fit);

/// How far a descent goes. Lengths of steps are in units.
struct StepPlan {
    int most;                        ///< steps
    double first, longest, shortest; ///< lengths of steps
    double too_little = 0;           ///< share of the value: the last step gains less
};

/// Changes the fit by steps that make value(fit) less while it holds all points, until there are none: each step solves
/// the problem with the constraints made linear (a sequence of quadratic programmes). `least`: the value of the fit,
/// and then of the result. slopes(fit): those of the value, to within a factor.
template <class Value, class Slopes>
void descend(Fit& fit, double& least, const Cloud& cloud, const StepPlan& plan, bool keep_axes, Value value,
             Slopes slopes) {
    double reach = plan.first;
    std::vector<Constraint> constraints;
    for (int k = 0; k < plan.most && reach > plan.shortest; ++k) {
        check_cancelled();
        const Variables gradient = slopes(fit);
        const double steepness = gradient.norm();
        if (!(steepness > 0)) {
            return;
        }
        set_constraints(fit, cloud, reach, constraints, keep_axes);
        const Variables step = quadratic_step(gradient, steepness / reach, constraints);
        const Fit next = stepped(fit, step, cloud);
        const double reached = value(next);
        if (!(reached < least)) {
            reach = std::min(reach, step.norm()) / 4;
            continue;
        }
        const double before = least;
        fit = next;
        least = reached;
        reach = std::min(plan.longest, 2 * reach);
        if (before - least < plan.too_little * before) {
            return;
        }
    }
}

/// Returns the area of the boundary, in square units.
inline double boundary_area(const Fit& fit) {
    using Kind = Element::Kind;
    constexpr double pi = std::numbers::pi;
    const Vec3& h = fit.half;
    const double r = fit.radius;
    if (fit.kind == Kind::ellipsoid) {
        return area_of_ellipsoid(fit);
    }
    return fit.kind == Kind::cylinder ? 2 * pi * r * (2 * h.z + r)
                                      : 8 * (h.x * h.y + h.y * h.z + h.z * h.x) + 4 * pi * r * (h.x + h.y + h.z + r);
}

/// As over_boundary(), of an ellipsoid.
template <class Visit> void over_ellipsoid(const Fit& fit, double area_each, Visit visit) {
    const Vec3& h = fit.half;
    const auto count = std::max<std::size_t>(32, static_cast<std::size_t>(area_of_ellipsoid(fit) / area_each));
    const double share = 4 * std::numbers::pi * h.x * h.y * h.z / static_cast<double>(count);
    for (const Vec3& n : fibonacci_directions(count)) {
        const Vec3 gradient{n.x / h.x, n.y / h.y, n.z / h.z}; // its length times the volume is the area of the image
        visit(Vec3{n.x * h.x, n.y * h.y, n.z * h.z}, normalized(gradient), share * norm(gradient));
    }
}

/// As over_boundary(), of the flat ends of a cylinder.
template <class Visit> void over_ends(const Fit& fit, double area_each, Visit visit) {
    constexpr double pi = std::numbers::pi;
    const double r = fit.radius;
    const int count = std::max(8, static_cast<int>(pi * r * r / area_each));
    const double area = pi * r * r / count;
    for (int k = 0; k < count; ++k) {
        const double radius = r * std::sqrt((k + 0.5) / count), angle = k * (pi * (3 - std::sqrt(5.0)));
        for (const double sign : {1.0, -1.0}) {
            visit(Vec3{radius * std::cos(angle), radius * std::sin(angle), sign * fit.half.z}, Vec3{0, 0, sign}, area);
        }
    }
}

/// Calls visit(point, normal, area) for points spread over the boundary, in the frame of the fit.
template <class Visit> void over_boundary(const Fit& fit, double area_each, Visit visit) {
    using Kind = Element::Kind;
    constexpr double pi = std::numbers::pi;
    const Vec3& h = fit.half;
    const double r = fit.radius;
    if (fit.kind == Kind::ellipsoid) {
        over_ellipsoid(fit, area_each, visit);
        return;
    }
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
    if (cylinder) {
        over_ends(fit, area_each, visit);
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
    const bool ellipsoid = fit.kind == Element::Kind::ellipsoid;
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
            const double outwards = ellipsoid ? n[k] * q[k] / fit.half[k] : std::abs(n[k]);
            g(6 + k) += uses_half(fit.kind, k) ? share * outwards : 0;
        }
        if (fit.kind != Element::Kind::box && !ellipsoid) {
            g(9) += fit.kind == Element::Kind::cylinder ? share * foam::hypot(n.x, n.y) : share;
        }
    });
    return g;
}

} // namespace foam::inline search::convex
