#include "fit_programme.hpp"

#include "ellipsoid_fit.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace foam::inline search::convex {
namespace {

using Kind = Element::Kind;

/// Writes the constraint that a point with direction `n` from the core (in the frame) stays within `room`.
Constraint constraint_of(const Vec3& q, const Vec3& n, double room) {
    const Vec3 w = cross(n, q); // d(n · R⁻¹ p) for a turn ω: -ω · (q × n)
    Constraint c{Variables::Zero(), room};
    c.slope << w.x, w.y, w.z, -n.x, -n.y, -n.z, 0, 0, 0, 0;
    return c;
}

bool is_ellipsoid(const Fit& fit) {
    return fit.kind == Kind::ellipsoid;
}

bool has_flat_end(Kind kind, int axis) {
    return kind == Kind::box || (kind == Kind::cylinder && axis == 2);
}

void add_length_constraints(const Fit& fit, std::vector<Constraint>& constraints) {
    for (int axis = 0; axis < 3; ++axis) {
        if (uses_half(fit.kind, axis)) {
            Constraint positive{Variables::Zero(), fit.half[axis] -
                                                      (has_flat_end(fit.kind, axis) || is_ellipsoid(fit) ? thin : 0)};
            positive.slope(6 + axis) = -1;
            constraints.push_back(positive);
        }
    }
    if (fit.kind != Kind::box && !is_ellipsoid(fit)) {
        Constraint positive{Variables::Zero(), fit.radius - thin};
        positive.slope(9) = -1;
        constraints.push_back(positive);
    }
}

/// Adds the constraint that a point stays within an ellipsoid, if a step may reach it.
void add_ellipsoid(const Fit& fit, const Vec3& q, double reach, std::vector<Constraint>& constraints) {
    double slope = 0;
    const Vec3 n = normal_of_ellipsoid(fit, q, slope);
    const double room = (1 - reach_of_ellipsoid(fit, q)) / slope; // to first order
    if (!(slope > 0) || room > reach) {
        return;
    }
    Constraint c = constraint_of(q, n, room);
    for (int axis = 0; axis < 3; ++axis) {
        c.slope(6 + axis) = -std::abs(n[axis] * q[axis] / fit.half[axis]);
    }
    constraints.push_back(c);
}

/// Adds the constraint that a point stays within the radius, if a step may reach it.
void add_round(const Fit& fit, const Vec3& q, double reach, std::vector<Constraint>& constraints) {
    const Vec3 d = fit.kind == Kind::cylinder ? Vec3{q.x, q.y, 0} : from_core(fit, q);
    const double room = fit.radius - reach;
    if (room > 0 && squared_norm(d) <= room * room) {
        return;
    }
    const double length = norm(d);
    if (!(length > 0)) {
        return;
    }
    const Vec3 n = d / length;
    Constraint c = constraint_of(q, n, fit.radius - length);
    for (int axis = 0; axis < 3; ++axis) {
        if (uses_half(fit.kind, axis) && !has_flat_end(fit.kind, axis)) {
            c.slope(6 + axis) = -std::abs(n[axis]);
        }
    }
    c.slope(9) = -1;
    constraints.push_back(c);
}

/// Adds the constraint that a point stays between flat ends, if a step may reach one.
void add_flat(const Fit& fit, const Vec3& q, double reach, std::vector<Constraint>& constraints) {
    for (int axis = 0; axis < 3; ++axis) {
        if (has_flat_end(fit.kind, axis) && std::abs(q[axis]) > fit.half[axis] - reach) {
            Vec3 n{};
            n[axis] = q[axis] > 0 ? 1.0 : -1.0;
            Constraint c = constraint_of(q, n, fit.half[axis] - std::abs(q[axis]));
            c.slope(6 + axis) = -1;
            constraints.push_back(c);
        }
    }
}

} // namespace

bool uses_half(Kind kind, int axis) {
    return kind == Kind::box || kind == Kind::swept_box || kind == Kind::ellipsoid || (kind != Kind::sphere && axis == 2);
}

Vec3 from_core(const Fit& fit, const Vec3& local) {
    const auto beyond = [](double t, double half) { return t > half ? t - half : t < -half ? t + half : 0.0; };
    return {beyond(local.x, fit.half.x), beyond(local.y, fit.half.y), beyond(local.z, fit.half.z)};
}

/// Returns whether a point in a fit, in its frame, is within a distance of the boundary.
static bool is_near_boundary(const Fit& fit, const Vec3& q, double distance) {
    if (is_ellipsoid(fit)) {
        double slope = 0;
        normal_of_ellipsoid(fit, q, slope);
        return reach_of_ellipsoid(fit, q) > 1 - distance * slope;
    }
    for (int axis = 0; axis < 3; ++axis) {
        if (has_flat_end(fit.kind, axis) && std::abs(q[axis]) > fit.half[axis] - distance) {
            return true;
        }
    }
    if (fit.kind == Kind::box) {
        return false;
    }
    const double room = fit.radius - distance;
    return room <= 0 || squared_norm(fit.kind == Kind::cylinder ? Vec3{q.x, q.y, 0} : from_core(fit, q)) > room * room;
}

void close_around(Fit& fit, const Cloud& cloud) {
    if (is_ellipsoid(fit)) {
        double farthest = 0;
        for (const Vec3& p : cloud.points) {
            farthest = std::max(farthest, reach_of_ellipsoid(fit, fit.local(p)));
        }
        for (int axis = 0; axis < 3; ++axis) {
            fit.half[axis] = std::max(fit.half[axis] * farthest, thin);
        }
        return;
    }
    double squared = 0;
    Vec3 length{};
    for (const Vec3& p : cloud.points) {
        const Vec3 q = fit.local(p);
        for (int axis = 0; axis < 3; ++axis) {
            length[axis] = std::max(length[axis], std::abs(q[axis]));
        }
        squared =
            std::max(squared, fit.kind == Kind::cylinder ? q.x * q.x + q.y * q.y : squared_norm(from_core(fit, q)));
    }
    for (int axis = 0; axis < 3; ++axis) {
        if (has_flat_end(fit.kind, axis)) {
            fit.half[axis] = std::max(length[axis], thin);
        }
    }
    if (fit.kind != Kind::box) {
        fit.radius = std::max(std::sqrt(squared), thin);
    }
}

Cloud near_boundary(const Fit& fit, const Cloud& cloud, double distance) {
    Cloud near;
    std::copy_if(cloud.points.begin(), cloud.points.end(), std::back_inserter(near.points),
                 [&](const Vec3& p) { return is_near_boundary(fit, fit.local(p), distance); });
    return near;
}

void set_constraints(const Fit& fit, const Cloud& cloud, double length, std::vector<Constraint>& constraints,
                     bool keep_axes) {
    // To first order, a point moves by at most the length of the step times that of its constraint's slope. The slope
    // has a part for turns, at most the distance of the point from the centre, and three others of length 1 at most.
    constexpr double steepest = 2;
    const double reach = steepest * length;
    constraints.clear();
    add_length_constraints(fit, constraints);
    for (const Vec3& p : cloud.points) {
        const Vec3 q = fit.local(p);
        if (is_ellipsoid(fit)) {
            add_ellipsoid(fit, q, reach, constraints);
        } else if (fit.kind != Kind::box) {
            add_round(fit, q, reach, constraints);
        }
        add_flat(fit, q, reach, constraints);
    }
    if (keep_axes) {
        for (Constraint& c : constraints) {
            c.slope.head<3>().setZero();
        }
    }
}

Fit stepped(const Fit& fit, const Variables& step, const Cloud& cloud) {
    Fit next = fit;
    const Vec3 move{step(3), step(4), step(5)};
    next.center = fit.center + fit.axes[0] * move.x + fit.axes[1] * move.y + fit.axes[2] * move.z;
    next.axes = turned(fit.axes, {step(0), step(1), step(2)});
    next.half = {std::max(fit.half.x + step(6), 0.0), std::max(fit.half.y + step(7), 0.0),
                 std::max(fit.half.z + step(8), 0.0)};
    close_around(next, cloud);
    return next;
}

Variables volume_slopes(const Fit& fit) {
    constexpr double pi = std::numbers::pi;
    Variables g = Variables::Zero();
    const Vec3& h = fit.half;
    const double r = fit.radius;
    if (is_ellipsoid(fit)) {
        for (int axis = 0; axis < 3; ++axis) {
            g(6 + axis) = volume(fit) / h[axis];
        }
    } else if (fit.kind == Kind::swept_box) {
        g(6) = 8 * h.y * h.z + 8 * r * (h.y + h.z) + 2 * pi * r * r;
        g(7) = 8 * h.x * h.z + 8 * r * (h.x + h.z) + 2 * pi * r * r;
        g(8) = 8 * h.x * h.y + 8 * r * (h.x + h.y) + 2 * pi * r * r;
        g(9) = 8 * (h.x * h.y + h.y * h.z + h.z * h.x) + 4 * pi * r * (h.x + h.y + h.z) + 4 * pi * r * r;
    } else {
        g(8) = 2 * pi * r * r;
        g(9) = 4 * pi * r * h.z + (fit.kind == Kind::capsule ? 4 * pi * r * r : 0);
    }
    return g;
}

} // namespace foam::inline search::convex
