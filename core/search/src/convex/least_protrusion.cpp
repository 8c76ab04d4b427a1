#include "least_protrusion.hpp"

#include "boundary.hpp"
#include "least_fit.hpp"

#include <foam/base/cancellation.hpp>

#include <cmath>
#include <optional>

namespace foam::inline search::convex {
namespace {

using Kind = Element::Kind;

/// How far an element protrudes that holds all of a solid. No place of its boundary is then inside the solid.
class Protrusion {
public:
    Protrusion(const Cloud& cloud, const Solid& solid, double power) : cloud_(cloud), solid_(solid), power_(power) {}

    /// Returns the mean of the power of the distance to the solid, and its root: close to the largest distance for a
    /// high power. Units.
    double of(const Fit& fit) const {
        constexpr double places = 400;
        double sum = 0, whole = 0;
        over_boundary(fit, boundary_area(fit) / places, [&](const Vec3& q, const Vec3&, double area) {
            sum += area * std::pow(norm(away(fit.outside(q))), power_);
            whole += area;
        });
        return std::pow(sum / whole, 1 / power_);
    }
    /// Returns its slopes, but for a factor and what the area of the boundary changes.
    Variables slopes(const Fit& fit, bool keep_axes) const {
        return boundary_slopes(fit, keep_axes, [&](const Vec3& p, const Vec3& normal, double area) {
            const Vec3 d = away(p);
            const double distance = norm(d);
            return distance > 0 ? area * std::pow(distance, power_ - 1) * (dot(d, normal) / distance) : 0;
        });
    }

private:
    /// Returns the way from the solid to a point.
    Vec3 away(const Vec3& p) const {
        const Vec3 at = cloud_.origin + p * cloud_.unit;
        return (at - solid_.closest(at).point) / cloud_.unit;
    }

    const Cloud& cloud_;
    const Solid& solid_;
    const double power_;
};

Fit descended(Fit best, const Cloud& cloud, const Protrusion& protrusion, int most_steps, bool keep_axes) {
    constexpr double first_reach = 0.05, longest = 0.1, shortest = 1e-4; // units
    double least = protrusion.of(best), reach = first_reach;
    std::vector<Constraint> constraints;
    for (int k = 0; k < most_steps && reach > shortest; ++k) {
        check_cancelled();
        Variables gradient = protrusion.slopes(best, keep_axes);
        const double length = gradient.norm();
        if (!(length > 0)) {
            break;
        }
        gradient /= length; // of a high power they may be minute
        set_constraints(best, cloud, reach, constraints, keep_axes);
        const Variables step = quadratic_step(gradient, 1 / reach, constraints);
        const Fit next = stepped(best, step, cloud);
        if (const double found = protrusion.of(next); found < least) {
            best = next;
            least = found;
            reach = std::min(longest, 2 * reach);
        } else {
            reach = std::min(reach, step.norm()) / 4;
        }
    }
    return best;
}

/// Returns elements of little volume. A swept box may be a box or a capsule, and is also begun half-way between.
std::vector<Fit> starts(Kind kind, const Cloud& cloud, Effort effort, bool axis_aligned) {
    std::vector<Fit> fits{least_fit(kind, cloud, effort, axis_aligned)};
    if (kind == Kind::swept_box) {
        fits.push_back(least_box(cloud, Effort::fast));
        for (const double share : {0.25, 0.5, 0.75}) {
            Fit fit = fits[1];
            fit.radius = share * std::min({fit.half.x, fit.half.y, fit.half.z});
            fit.half = fit.half - Vec3{fit.radius, fit.radius, fit.radius};
            fits.push_back(fit);
        }
        fits.push_back(least_capsule(cloud, Effort::fast));
        for (Fit& fit : fits) {
            fit.kind = kind;
            close_around(fit, cloud);
        }
    }
    return fits;
}

} // namespace

Fit least_protrusion(Kind kind, const Cloud& cloud, const Solid& solid, ApproximationObjective objective, Effort effort,
                     bool axis_aligned) {
    const bool mean = objective == ApproximationObjective::mean_protrusion;
    const Protrusion smooth(cloud, solid, mean ? 1 : 12);
    const int steps = effort == Effort::best ? 100 : 25;
    const bool keep_axes = axis_aligned && kind == Kind::box;
    std::optional<Fit> best;
    for (const Fit& start : starts(kind, cloud, effort, axis_aligned)) {
        const Fit found = descended(start, cloud, smooth, steps, keep_axes);
        if (!best || smooth.of(found) < smooth.of(*best)) {
            best = found;
        }
    }
    return mean ? *best : descended(*best, cloud, Protrusion(cloud, solid, 48), steps, keep_axes);
}

} // namespace foam::inline search::convex
