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

/// Finds the element that protrudes least by one measure.
class LeastProtrusion {
public:
    LeastProtrusion(const Cloud& cloud, const Protrusion& protrusion, Effort effort, bool axis_aligned)
        : cloud_(cloud), protrusion_(protrusion), effort_(effort), axis_aligned_(axis_aligned) {}

    Fit least(Kind kind) const {
        std::optional<Fit> best;
        for (const Fit& start : starts(kind)) {
            const Fit found = further(start);
            if (!best || protrusion_.of(found) < protrusion_.of(*best)) {
                best = found;
            }
        }
        return *best;
    }
    Fit further(const Fit& fit) const {
        const int steps = effort_ == Effort::best ? 100 : 25;
        return descended(fit, cloud_, protrusion_, steps, axis_aligned_ && fit.kind == Kind::box);
    }

private:
    /// Returns elements to begin from. A swept box may be a capsule, a box, or something between box and ball.
    std::vector<Fit> starts(Kind kind) const {
        std::vector<Fit> fits{least_fit(kind, cloud_, effort_, axis_aligned_)};
        if (kind == Kind::swept_box) {
            const Fit box = least(Kind::box);
            fits.push_back(least(Kind::capsule));
            for (const double share : {0.0, 0.25, 0.5, 0.75}) {
                Fit fit = box;
                fit.radius = share * std::min({box.half.x, box.half.y, box.half.z});
                fit.half = box.half - Vec3{fit.radius, fit.radius, fit.radius};
                fits.push_back(fit);
            }
            for (Fit& fit : fits) {
                fit.kind = kind;
                close_around(fit, cloud_);
            }
        }
        return fits;
    }

    const Cloud& cloud_;
    const Protrusion& protrusion_;
    const Effort effort_;
    const bool axis_aligned_;
};

} // namespace

Fit least_protrusion(Element::Kind kind, const Cloud& cloud, const Solid& solid, ApproximationObjective objective,
                     Effort effort, bool axis_aligned) {
    const bool mean = objective == ApproximationObjective::mean_protrusion;
    const Protrusion smooth(cloud, solid, mean ? 1 : 12), sharp(cloud, solid, 48);
    const Fit fit = LeastProtrusion(cloud, smooth, effort, axis_aligned).least(kind);
    return mean ? fit : LeastProtrusion(cloud, sharp, effort, axis_aligned).further(fit);
}

} // namespace foam::inline search::convex
