// Branch and bound over orientations.
#include "least_fit.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/search/cover.hpp>
#include <foam/search/least_element.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <queue>

namespace foam::inline search {
namespace convex {
namespace {

using Kind = Element::Kind;

class Proof {
public:
    Proof(Kind kind, const Cloud& cloud, double tolerance)
        : kind_(kind), cloud_(cloud), tolerance_(tolerance), best_(least_fit(kind, cloud, Effort::best)) {}
    void run() {
        for (const Orientations& cell : all_orientations(of_axis())) {
            look_at(cell);
        }
        while (waiting_.top().lower_bound < volume(best_) / (1 + tolerance_)) { // each cell that is taken leaves parts
            check_cancelled();
            const Orientations cell = waiting_.top();
            waiting_.pop();
            for (const Orientations& part : parts_of(cell, of_axis())) {
                look_at(part);
            }
        }
    }
    const Fit& best() const { return best_; }
    /// Returns the least bound of the cells, which have all orientations; rounding puts none above what was found.
    double bound() const { return std::min(volume(best_), waiting_.top().lower_bound); }
    std::size_t cells() const { return cells_; }

private:
    bool of_axis() const { return kind_ != Kind::box; }
    void look_at(Orientations cell) {
        constexpr std::size_t most = 1'000'000;
        if (++cells_ > most) {
            throw Error(ErrorCode::geometry, fmt::format("the least {} is not proved to {} within {} cells; remedy: a "
                                                         "larger tolerance",
                                                         to_string(kind_), tolerance_, most));
        }
        const double angle = reach(cell, of_axis());
        Fit here;
        if (kind_ == Kind::box) {
            const std::array<Vec3, 3> axes = axes_at(cell.at);
            here = box_along(cloud_, axes);
            cell.lower_bound = bound_of_box(cloud_, axes, angle);
        } else if (kind_ == Kind::cylinder) {
            here = cylinder_along(cloud_, direction_at(cell));
            cell.lower_bound = bound_of_cylinder(cloud_, here, angle);
        } else {
            constexpr int steps = 60;
            here = descended(capsule_along(cloud_, direction_at(cell)), cloud_, steps, 0.1, true);
            cell.lower_bound = bound_of_capsule(volume(here), angle);
        }
        if (volume(here) < volume(best_)) {
            best_ = here;
        }
        waiting_.push(cell);
    }

    const Kind kind_;
    const Cloud& cloud_;
    const double tolerance_;
    Fit best_;
    std::size_t cells_ = 0;
    std::priority_queue<Orientations> waiting_; ///< the least bound first
};

} // namespace
} // namespace convex

ProvedElement proved_least(Element::Kind kind, std::span<const Vec3> points, double tolerance) {
    using Kind = Element::Kind;
    if ((kind != Kind::box && kind != Kind::cylinder && kind != Kind::capsule) || !(tolerance > 0)) {
        throw Error(ErrorCode::usage, fmt::format("no proof of the least {} to a tolerance of {}; remedy: a box, a "
                                                  "cylinder or a capsule, and a tolerance above 0",
                                                  to_string(kind), tolerance));
    }
    if (points.empty() || !std::all_of(points.begin(), points.end(), [](const Vec3& p) { return is_finite(p); })) {
        throw Error(ErrorCode::geometry, "an element needs one or more points with finite coordinates");
    }
    const convex::Cloud cloud = convex::cloud_of(points);
    convex::Proof proof(kind, cloud, tolerance);
    proof.run();
    const double cube = cloud.unit * cloud.unit * cloud.unit;
    const Element element = convex::element_of(proof.best(), cloud);
    return {element, volume(element), proof.bound() * cube, proof.cells()};
}

} // namespace foam::inline search
