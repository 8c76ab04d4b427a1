#include "circle.hpp"
#include "least_fit.hpp"
#include "quadratic_step.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/geometry/directions.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace foam::inline search::convex {
namespace {

using Kind = Element::Kind;

/// The points as seen along a direction.
struct Seen {
    std::array<Vec3, 3> axes;
    Circle circle; ///< around the projection
    double low = 0, high = 0;
};

Seen seen_along(const Cloud& cloud, const Vec3& direction) {
    Seen seen{.axes = frame_along(direction), .circle = {}};
    static thread_local std::vector<Vec2> flat;
    flat.clear();
    seen.low = seen.high = dot(direction, cloud.points.front());
    for (const Vec3& p : cloud.points) {
        flat.push_back({dot(seen.axes[0], p), dot(seen.axes[1], p)});
        const double t = dot(direction, p);
        seen.low = std::min(seen.low, t);
        seen.high = std::max(seen.high, t);
    }
    seen.circle = smallest_circle(flat);
    return seen;
}

/// Returns the vector from the nearest point of the core of a fit, in the frame of the fit.
Vec3 from_core(const Fit& fit, const Vec3& local) {
    const auto beyond = [](double t, double half) { return t > half ? t - half : t < -half ? t + half : 0.0; };
    return {beyond(local.x, fit.half.x), beyond(local.y, fit.half.y), beyond(local.z, fit.half.z)};
}

/// Makes the lengths of a fit the least that hold the points, about its core: its radius, and a cylinder's half length.
void close_around(Fit& fit, const Cloud& cloud) {
    double squared = 0, length = 0;
    for (const Vec3& p : cloud.points) {
        const Vec3 q = fit.local(p);
        if (fit.kind == Kind::cylinder) {
            squared = std::max(squared, q.x * q.x + q.y * q.y);
            length = std::max(length, std::abs(q.z));
        } else {
            squared = std::max(squared, squared_norm(from_core(fit, q)));
        }
    }
    fit.radius = std::max(std::sqrt(squared), thin);
    if (fit.kind == Kind::cylinder) {
        fit.half.z = std::max(length, thin);
    }
}

/// The variables of a fit: rotation (3, in its frame), centre (3, in its frame), half lengths (3), radius.
Variables gradient_of(const Fit& fit) {
    constexpr double pi = std::numbers::pi;
    Variables g = Variables::Zero();
    const Vec3& h = fit.half;
    const double r = fit.radius;
    if (fit.kind == Kind::swept_box) {
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

/// Writes the constraint that a point with direction `n` from the core (in the frame) stays within `room`.
Constraint constraint_of(const Vec3& q, const Vec3& n, double room) {
    const Vec3 w = cross(n, q); // d(n · R⁻¹ p) for a turn ω: -ω · (q × n)
    Constraint c{Variables::Zero(), room};
    c.slope << w.x, w.y, w.z, -n.x, -n.y, -n.z, 0, 0, 0, 0;
    return c;
}

void add_length_constraints(const Fit& fit, std::vector<Constraint>& constraints) {
    const int first = fit.kind == Kind::swept_box ? 6 : 8;
    for (int i = first; i <= 9; ++i) {
        Constraint positive{Variables::Zero(), i == 9 ? fit.radius - thin : fit.half[i - 6]};
        if (i == 8 && fit.kind == Kind::cylinder) {
            positive.room -= thin;
        }
        positive.slope(i) = -1;
        constraints.push_back(positive);
    }
}

/// Writes the constraints of points that a step of this length may reach.
void set_constraints(const Fit& fit, const Cloud& cloud, double reach, std::vector<Constraint>& constraints) {
    constraints.clear();
    add_length_constraints(fit, constraints);
    for (const Vec3& p : cloud.points) {
        const Vec3 q = fit.local(p);
        const Vec3 d = fit.kind == Kind::cylinder ? Vec3{q.x, q.y, 0} : from_core(fit, q);
        const double length = norm(d);
        if (length > 0 && length > fit.radius - reach) {
            const Vec3 n = d / length;
            Constraint c = constraint_of(q, n, fit.radius - length);
            if (fit.kind != Kind::cylinder) {
                c.slope(6) = fit.kind == Kind::swept_box ? -std::abs(n.x) : 0;
                c.slope(7) = fit.kind == Kind::swept_box ? -std::abs(n.y) : 0;
                c.slope(8) = -std::abs(n.z);
            }
            c.slope(9) = -1;
            constraints.push_back(c);
        }
        if (fit.kind == Kind::cylinder && std::abs(q.z) > fit.half.z - reach) {
            const Vec3 n{0, 0, q.z > 0 ? 1.0 : -1.0};
            Constraint c = constraint_of(q, n, fit.half.z - std::abs(q.z));
            c.slope(8) = -1;
            constraints.push_back(c);
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

/// Returns directions to start from: those of a box around the points, and others spread over the hemisphere.
std::vector<Vec3> start_directions(const Cloud& cloud, Effort effort) {
    const Fit box = quick_box(cloud);
    std::vector<Vec3> directions(box.axes.begin(), box.axes.end());
    const std::size_t spread = effort == Effort::fast ? 16 : effort == Effort::normal ? 48 : 300;
    for (const Vec3& direction : fibonacci_directions(2 * spread)) {
        if (direction.z >= 0) {
            directions.push_back(direction);
        }
    }
    return directions;
}

/// Returns the best result of descents from the best fits along directions.
template <class Along> Fit least_along(const Cloud& cloud, Effort effort, Along along) {
    std::vector<Fit> starts;
    for (const Vec3& direction : start_directions(cloud, effort)) {
        check_cancelled();
        starts.push_back(along(cloud, direction));
    }
    std::stable_sort(starts.begin(), starts.end(), [](const Fit& a, const Fit& b) { return volume(a) < volume(b); });
    const std::size_t descents = effort == Effort::fast ? 2 : effort == Effort::normal ? 6 : 40;
    const int steps = effort == Effort::fast ? 15 : 60;
    Fit best = starts.front();
    for (std::size_t i = 0; i < std::min(descents, starts.size()); ++i) {
        if (const Fit found = descended(starts[i], cloud, steps); volume(found) < volume(best) * (1 - 1e-9)) {
            best = found;
        }
    }
    return best;
}

/// Returns the swept box of the same bounds as a box with the largest radius that still holds the points.
Fit rounded(const Fit& box, const Cloud& cloud) {
    Fit fit = box;
    fit.kind = Kind::swept_box;
    const double most = std::min({box.half.x, box.half.y, box.half.z});
    double low = 0, high = most;
    const auto at = [&](double radius) {
        fit.half = box.half - Vec3{radius, radius, radius};
        for (const Vec3& p : cloud.points) {
            if (squared_norm(from_core(fit, fit.local(p))) > radius * radius * (1 + 1e-12)) {
                return false;
            }
        }
        return true;
    };
    constexpr int halvings = 30;
    for (int i = 0; i < halvings; ++i) {
        const double middle = (low + high) / 2;
        (at(middle) ? low : high) = middle;
    }
    fit.radius = low;
    fit.half = box.half - Vec3{low, low, low};
    close_around(fit, cloud);
    return fit;
}

} // namespace

Fit descended(const Fit& start, const Cloud& cloud, int most_steps, bool keep_axes) {
    constexpr double shortest = 1e-8, longest = 0.1; // units
    Fit best = start;
    double least = volume(best);
    double reach = longest;
    std::vector<Constraint> constraints;
    for (int i = 0; i < most_steps && reach > shortest; ++i) {
        check_cancelled();
        const Variables gradient = gradient_of(best);
        set_constraints(best, cloud, 6 * reach, constraints);
        if (keep_axes) {
            for (Constraint& c : constraints) {
                c.slope.head<3>().setZero();
            }
        }
        const Variables step = quadratic_step(gradient, gradient.norm() / reach, constraints);
        const Fit next = stepped(best, step, cloud);
        const double reached = volume(next);
        if (reached < least) {
            const double gain = (least - reached) / least;
            best = next;
            least = reached;
            reach = std::min(longest, 2 * reach);
            if (gain < 1e-9) {
                break;
            }
        } else {
            reach = std::min(reach, step.norm()) / 4;
        }
    }
    return best;
}

Fit least_sphere(const Cloud& cloud) {
    const Sphere ball = minimum_enclosing_sphere(cloud.points);
    return {.kind = Kind::sphere, .center = ball.center, .radius = std::max(ball.radius, thin)};
}

Fit cylinder_along(const Cloud& cloud, const Vec3& direction) {
    const Seen seen = seen_along(cloud, direction);
    Fit fit{.kind = Kind::cylinder, .axes = seen.axes};
    fit.center = fit.outside({seen.circle.center.x, seen.circle.center.y, (seen.low + seen.high) / 2});
    close_around(fit, cloud);
    return fit;
}

Fit capsule_along(const Cloud& cloud, const Vec3& direction) {
    const Seen seen = seen_along(cloud, direction);
    const Vec2& c = seen.circle.center;
    const double r = std::max(seen.circle.radius, thin) * (1 + 1e-12);
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vec3& p : cloud.points) {
        const double x = dot(seen.axes[0], p) - c.x, y = dot(seen.axes[1], p) - c.y, t = dot(direction, p);
        const double depth = std::sqrt(std::max(r * r - x * x - y * y, 0.0));
        low = std::min(low, t + depth);
        high = std::max(high, t - depth);
    }
    Fit fit{.kind = Kind::capsule, .axes = seen.axes};
    fit.center = fit.outside({c.x, c.y, (low + high) / 2});
    fit.half.z = std::max((high - low) / 2, 0.0);
    close_around(fit, cloud);
    return fit;
}

Fit least_cylinder(const Cloud& cloud, Effort effort) {
    return least_along(cloud, effort, cylinder_along);
}

Fit least_capsule(const Cloud& cloud, Effort effort) {
    Fit fit = least_along(cloud, effort, capsule_along);
    Fit ball = least_sphere(cloud);
    ball.kind = Kind::capsule;
    return volume(ball) < volume(fit) ? ball : fit;
}

Fit least_swept_box(const Cloud& cloud, Effort effort) {
    const int steps = effort == Effort::fast ? 15 : 80;
    Fit box = least_box(cloud, effort);
    Fit capsule = least_capsule(cloud, Effort::fast); // a start, no more
    capsule.kind = Kind::swept_box;
    Fit best = capsule;
    for (const Fit& start : {rounded(box, cloud), capsule, rounded(box_along(cloud, capsule.axes), cloud)}) {
        if (const Fit found = descended(start, cloud, steps); volume(found) < volume(best)) {
            best = found;
        }
    }
    return best;
}

static Fit upright_box(const Cloud& cloud) {
    return box_along(cloud, {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}});
}

Fit quick_fit(Kind kind, const Cloud& cloud, bool axis_aligned) {
    if (kind == Kind::sphere) {
        return least_sphere(cloud);
    }
    if (kind == Kind::box && axis_aligned) {
        return upright_box(cloud);
    }
    const Fit box = quick_box(cloud);
    if (kind == Kind::box) {
        return box;
    }
    Fit best = kind == Kind::swept_box ? rounded(box, cloud) : Fit{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Fit fit = kind == Kind::cylinder ? cylinder_along(cloud, box.axes[axis]) : capsule_along(cloud, box.axes[axis]);
        fit.kind = kind;
        if ((axis == 0 && kind != Kind::swept_box) || volume(fit) < volume(best)) {
            best = fit;
        }
    }
    return best;
}

Fit least_fit(Kind kind, const Cloud& cloud, Effort effort, bool axis_aligned) {
    switch (kind) {
    case Kind::sphere:
        return least_sphere(cloud);
    case Kind::capsule:
        return least_capsule(cloud, effort);
    case Kind::cylinder:
        return least_cylinder(cloud, effort);
    case Kind::box:
        return axis_aligned ? upright_box(cloud) : least_box(cloud, effort);
    case Kind::swept_box:
    case Kind::hull:
        break;
    }
    return least_swept_box(cloud, effort);
}

} // namespace foam::inline search::convex
