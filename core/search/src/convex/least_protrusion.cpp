#include "least_fit.hpp"

#include "fit_programme.hpp"

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
        const Variables g = boundary_slopes(fit, keep_axes, [&](const Vec3& p, const Vec3& normal, double area) {
            const Vec3 d = away(p);
            const double distance = norm(d);
            return distance > 0 ? area * std::pow(distance, power_ - 1) * (dot(d, normal) / distance) : 0;
        });
        const double length = g.norm(); // of a high power it may be minute
        return length > 0 ? Variables(g / length) : g;
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
    Fit further(Fit fit) const {
        const bool keep_axes = axis_aligned_ && fit.kind == Kind::box;
        const StepPlan plan{
            .most = effort_ == Effort::best ? 100 : 25, .first = 0.05, .longest = 0.1, .shortest = 1e-4};
        double least = protrusion_.of(fit);
        descend(
            fit, least, cloud_, plan, keep_axes, [&](const Fit& f) { return protrusion_.of(f); },
            [&](const Fit& f) { return protrusion_.slopes(f, keep_axes); });
        return fit;
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

Fit least_protrusion(Element::Kind kind, const Cloud& cloud, const Solid& solid, Objective objective,
                     Effort effort, bool axis_aligned) {
    const bool mean = objective == Objective::mean_protrusion;
    const Protrusion smooth(cloud, solid, mean ? 1 : 12), sharp(cloud, solid, 48);
    const Fit fit = LeastProtrusion(cloud, smooth, effort, axis_aligned).least(kind);
    return mean ? fit : LeastProtrusion(cloud, sharp, effort, axis_aligned).further(fit);
}

} // namespace foam::inline search::convex
