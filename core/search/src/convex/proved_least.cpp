// Branch and bound over orientations.
#include "least_fit.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/search/least_element.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>

namespace foam::inline search {
namespace convex {
namespace {

using Kind = Element::Kind;
constexpr double pi = std::numbers::pi;

/// Orientations about one in the middle. Of a box: Rodrigues vectors in a cube, of which the cube within tan(π/8) has
/// all orientations of a box. Of an axis: points on one of three faces of a cube, by central projection; all directions
/// but for their sign. Both projections are gnomonic, so the farthest orientation from the middle is at a corner.
struct Orientations {
    Vec3 at{};
    double half = 0;
    int face = 0; ///< of an axis
    double lower_bound = 0;

    bool operator<(const Orientations& o) const { return lower_bound > o.lower_bound; } // least first
};

std::array<Vec3, 3> axes_at(const Vec3& r) {
    const double n = norm(r);
    const Pose turn = n > 0 ? Pose::from_axis_angle(r / n, 2 * std::atan(n)) : Pose{};
    return {turn.rotation[0], turn.rotation[1], turn.rotation[2]};
}

Vec3 direction_at(const Orientations& cell) {
    Vec3 d;
    d[cell.face] = 1;
    d[(cell.face + 1) % 3] = cell.at.x;
    d[(cell.face + 2) % 3] = cell.at.y;
    return normalized(d);
}

/// Returns the largest angle between the middle orientation of a cell and another one in it.
double reach(const Orientations& cell, bool of_axis) {
    double least = 1;
    const double length = 1 + squared_norm(cell.at);
    for (int k = 0; k < (of_axis ? 4 : 8); ++k) {
        const Vec3 corner = cell.at + Vec3{k & 1 ? cell.half : -cell.half, k & 2 ? cell.half : -cell.half,
                                           of_axis ? 0 : (k & 4 ? cell.half : -cell.half)};
        least = std::min(least, (1 + dot(cell.at, corner)) / std::sqrt(length * (1 + squared_norm(corner))));
    }
    const double angle = std::acos(std::clamp(least, -1.0, 1.0)) + 1e-12;
    return of_axis ? angle : 2 * angle; // quaternions turn by half the angle
}

/// Returns a length that the points' extent along no axis within the angle falls short of.
double least_extent(const Cloud& cloud, const Vec3& axis, double angle) {
    const auto [low, high] =
        std::minmax_element(cloud.points.begin(), cloud.points.end(),
                            [&](const Vec3& a, const Vec3& b) { return dot(a, axis) < dot(b, axis); });
    const Vec3 d = *high - *low;
    const double length = norm(d);
    const double between = length > 0 ? std::acos(std::clamp(dot(d, axis) / length, -1.0, 1.0)) : 0;
    return std::max(length * std::cos(std::min(between + angle, pi / 2)), 2 * thin);
}

double bound_of_box(const Cloud& cloud, const std::array<Vec3, 3>& axes, double angle) {
    double bound = 1;
    for (const Vec3& axis : axes) {
        bound *= least_extent(cloud, axis, angle);
    }
    return bound;
}

/// The least cylinder along another direction, turned to this one, is in a cylinder whose radius is larger by half its
/// length times the sine; its length is at most what this one's becomes when it is turned there.
double bound_of_cylinder(const Cloud& cloud, const Fit& here, double angle) {
    const double sine = std::sin(std::min(angle, pi / 2));
    const double length = 2 * here.half.z + 2 * here.radius * sine;
    const double radius = std::max(here.radius - length / 2 * sine, thin);
    return pi * radius * radius * least_extent(cloud, here.axes[2], angle);
}

double capsule_radius(double volume_of, double length) {
    double low = 0, high = std::cbrt(volume_of * 3 / (4 * pi));
    for (int i = 0; i < 60; ++i) {
        const double r = (low + high) / 2;
        (pi * r * r * length + 4 * pi / 3 * r * r * r < volume_of ? low : high) = r;
    }
    return high;
}

/// A capsule along another direction, turned to this one, is in one whose radius is larger by its length times the sine
/// of half the angle. So the least volume there is at least that here without a layer of this thickness; the thickest
/// of the layers for all lengths up to the size of the points counts.
double bound_of_capsule(double here, double angle) {
    const double sine = std::sin(std::min(angle / 2, pi / 2));
    constexpr int steps = 40;
    double loss = 0;
    for (int i = 0; i < steps; ++i) {
        const double shorter = static_cast<double>(i) / steps, longer = static_cast<double>(i + 1) / steps;
        const double r = capsule_radius(here, shorter);
        loss = std::max(loss, longer * sine * (2 * pi * r * longer + 4 * pi * r * r));
    }
    return here - loss;
}

class Proof {
public:
    Proof(Kind kind, const Cloud& cloud, double tolerance) : kind_(kind), cloud_(cloud), tolerance_(tolerance) {
        best_ = least_fit(kind, cloud, Effort::best);
        least_ = volume(best_);
    }
    void run() {
        start();
        while (!waiting_.empty() && waiting_.top().lower_bound < least_ / (1 + tolerance_)) {
            check_cancelled();
            const Orientations cell = waiting_.top();
            waiting_.pop();
            halve(cell);
        }
        bound_ = std::min(least_, settled_);
        if (!waiting_.empty()) {
            bound_ = std::min(bound_, waiting_.top().lower_bound);
        }
    }
    const Fit& best() const { return best_; }
    double bound() const { return bound_; }
    std::size_t cells() const { return cells_; }

private:
    bool of_axis() const { return kind_ != Kind::box; }
    void start() {
        if (of_axis()) {
            for (int face = 0; face < 3; ++face) {
                look_at({.half = 1, .face = face});
            }
        } else {
            look_at({.half = std::tan(pi / 8) * (1 + 1e-12)});
        }
    }
    void halve(const Orientations& cell) {
        const double h = cell.half / 2;
        for (int k = 0; k < (of_axis() ? 4 : 8); ++k) {
            Orientations part = cell;
            part.half = h;
            part.at += {k & 1 ? h : -h, k & 2 ? h : -h, of_axis() ? 0 : (k & 4 ? h : -h)};
            look_at(part);
        }
    }
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
        if (volume(here) < least_) {
            best_ = here;
            least_ = volume(here);
        }
        if (cell.lower_bound < least_ / (1 + tolerance_)) {
            waiting_.push(cell);
        } else {
            settled_ = std::min(settled_, cell.lower_bound);
        }
    }

    const Kind kind_;
    const Cloud& cloud_;
    const double tolerance_;
    Fit best_;
    double least_ = 0, bound_ = 0;
    double settled_ = std::numeric_limits<double>::infinity();
    std::size_t cells_ = 0;
    std::priority_queue<Orientations> waiting_;
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
