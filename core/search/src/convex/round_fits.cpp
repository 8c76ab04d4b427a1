#include "ellipsoid_fit.hpp"
#include "fit_programme.hpp"
#include "least_fit.hpp"
#include "plane.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/geometry/vector.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

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

/// Returns the result of a descent about few of the points, and then about those near the boundary; it is never larger.
/// Precondition: the start holds all points.
Fit quickly_descended(const Fit& start, const Cloud& coarse, const Cloud& cloud) {
    constexpr int steps = 15, last_steps = 6;
    constexpr double last_reach = 0.01, near = 6 * last_reach; // units
    Fit best = start;
    const auto take = [&](Fit found) {
        close_around(found, cloud);
        if (volume(found) < volume(best)) {
            best = found;
        }
    };
    take(descended(start, coarse, steps));
    take(descended(best, near_boundary(best, cloud, near), last_steps, last_reach));
    return best;
}

/// Returns the best result of descents from the best fits along directions. Of many points, the extreme ones tell which
/// directions are worth a look at all; the descents of Effort::fast are mostly about these, too.
template <class Along> Fit least_along(const Cloud& cloud, Effort effort, Along along) {
    Cloud coarse;
    const bool fast = effort == Effort::fast;
    coarse.points = fast ? few_extremes_of(cloud.points) : extremes_of(cloud.points);
    std::vector<Fit> starts;
    for (const Vec3& direction : start_directions(coarse, effort)) {
        check_cancelled();
        starts.push_back(along(coarse, direction));
    }
    std::stable_sort(starts.begin(), starts.end(), [](const Fit& a, const Fit& b) { return volume(a) < volume(b); });
    const std::size_t descents = fast ? 2 : effort == Effort::normal ? 6 : 40;
    std::optional<Fit> best;
    for (std::size_t i = 0; i < std::min(descents, starts.size()); ++i) {
        close_around(starts[i], cloud);
        const Fit found = fast ? quickly_descended(starts[i], coarse, cloud) : descended(starts[i], cloud, 60);
        if (!best || volume(found) < volume(*best) * (1 - 1e-9)) {
            best = found;
        }
    }
    return *best;
}

/// Returns the largest radius up to `most` with which a swept box still holds a point. `inset`: how far the point lies
/// inside each face of the swept box's bounds.
double radius_for(const Vec3& inset, double most) {
    const auto holds = [&](double radius) {
        double squared = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const double beyond = std::max(radius - inset[axis], 0.0);
            squared += beyond * beyond;
        }
        return squared <= radius * radius * (1 + 1e-12);
    };
    if (holds(most)) {
        return most;
    }
    double low = 0, high = most;
    constexpr int halvings = 30;
    for (int i = 0; i < halvings; ++i) {
        const double middle = (low + high) / 2;
        (holds(middle) ? low : high) = middle;
    }
    return low;
}

/// Returns the swept box of the same bounds as a box with the largest radius that still holds the points.
Fit rounded(const Fit& box, const Cloud& cloud) {
    double radius = std::min({box.half.x, box.half.y, box.half.z});
    for (const Vec3& p : cloud.points) {
        const Vec3 q = box.local(p);
        radius = radius_for(box.half - Vec3{std::abs(q.x), std::abs(q.y), std::abs(q.z)}, radius);
    }
    Fit fit = box;
    fit.kind = Kind::swept_box;
    fit.radius = radius;
    fit.half = box.half - Vec3{radius, radius, radius};
    close_around(fit, cloud);
    return fit;
}

} // namespace

Fit descended(const Fit& start, const Cloud& cloud, int most_steps, double first_reach, bool keep_axes) {
    Fit fit = start;
    double least = volume(fit);
    const StepPlan plan{.most = most_steps, .first = first_reach, .longest = 0.1, .shortest = 1e-8, .too_little = 1e-9};
    descend(
        fit, least, cloud, plan, keep_axes, [](const Fit& f) { return volume(f); }, volume_slopes);
    return fit;
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
    const bool fast = effort == Effort::fast;
    constexpr int steps = 80;
    Cloud coarse;
    if (fast) {
        coarse.points = few_extremes_of(cloud.points);
    }
    const Fit box = least_box(cloud, effort);
    Fit capsule = least_capsule(cloud, Effort::fast); // a start, no more
    capsule.kind = Kind::swept_box;
    Fit best = box; // without a radius
    best.kind = Kind::swept_box;
    close_around(best, cloud);
    const Cloud& seen = fast ? coarse : cloud;
    for (Fit start : {rounded(box, seen), capsule, rounded(box_along(cloud, capsule.axes), seen)}) {
        close_around(start, cloud);
        const Fit found = fast ? quickly_descended(start, coarse, cloud) : descended(start, cloud, steps);
        if (volume(found) < volume(best)) {
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
    if (kind == Kind::ellipsoid) {
        return least_ellipsoid(cloud, 0.05, 40);
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
    case Kind::ellipsoid:
        return effort == Effort::fast ? least_ellipsoid(cloud, 1e-3, 300) : least_ellipsoid(cloud, 1e-7, 20'000);
    case Kind::swept_box:
    case Kind::hull:
        break;
    }
    return least_swept_box(cloud, effort);
}

} // namespace foam::inline search::convex
