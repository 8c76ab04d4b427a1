#include <foam/collision/separation.hpp>

#include "simplex.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace foam::inline collision {
namespace {

constexpr double rounding_of_distances = 1e-12;

/// An element in the common frame: a core, widened by a radius where the kind allows it.
class Placed {
public:
    Placed(const Element& element, const Pose& link)
        : core_(moved(element, link)), radius_(widening(element)), own_(element.radius) {
        core_.radius -= radius_;
    }

    /// Returns the radius around the core.
    double radius() const { return radius_; }
    /// Returns the farthest point of the core along a direction.
    Vec3 support(const Vec3& direction) const { return foam::support(core_, direction); }

    /// Returns a point in the middle.
    Vec3 middle() const {
        if (!core_.hull) {
            return core_.pose.translation;
        }
        Box box;
        for (const Vec3& vertex : core_.hull->surface.vertices) {
            box.add(vertex);
        }
        return core_.pose * box.center();
    }

    /// Returns the radius of a ball around the point that lies in the element; negative if the point does not.
    double depth_at(const Vec3& point) const { return radius_ - signed_distance(core_, point); }

    double size() const {
        double size = norm(core_.half) + own_;
        if (core_.hull) {
            for (const Vec3& vertex : core_.hull->surface.vertices) {
                size = std::max(size, norm(vertex));
            }
        }
        return size;
    }

private:
    Element core_;
    double radius_, own_;
};

/// The result for two cores.
struct Cores {
    double low = 0;   ///< m; their distance is at least this
    double high = 0;  ///< m; the distance of two points of theirs
    Vec3 in_first{};  ///< the point of the first
};

/// Returns the distance of two cores, to a millionth.
Cores distance_of_cores(const Placed& a, const Placed& b) {
    constexpr int most_steps = 100;
    constexpr double enough = 1e-6;
    Simplex simplex;
    Vec3 between = a.middle() - b.middle();
    between = between == Vec3{} ? Vec3{1, 0, 0} : between;
    Cores result{.low = 0, .high = std::numeric_limits<double>::infinity()};
    for (int step = 0; step < most_steps; ++step) {
        const double length = norm(between);
        const Vec3 first = a.support(-between), second = b.support(between);
        const Vec3 corner = first - second;
        result.low = std::max(result.low, dot(between, corner) / length);
        if (step > 0 && length - result.low <= enough * length) {
            break;
        }
        simplex.add({corner, first});
        const Vec3 closest = simplex.closest();
        const double closer = norm(closest);
        if (!(closer < result.high)) {
            break; // rounding
        }
        result.high = closer;
        result.in_first = simplex.in_first();
        if (closer == 0) { // a simplex with four corners is around the origin
            break;
        }
        between = closest;
    }
    return result;
}

/// Returns the largest sum of the radii of balls around one point that lie in each of the elements, from below: by
/// steps from a point of both; -∞ where none is found. The sum is concave.
double depth_of(const Placed& a, const Placed& b, const Vec3& from) {
    const auto sum_at = [&](const Vec3& point) {
        const double in_a = a.depth_at(point), in_b = b.depth_at(point);
        return in_a < 0 || in_b < 0 ? -std::numeric_limits<double>::infinity() : in_a + in_b;
    };
    Vec3 at = from;
    double best = sum_at(at);
    for (const Vec3& other : {a.middle(), b.middle(), (a.middle() + b.middle()) * 0.5}) {
        if (const double sum = sum_at(other); sum > best) {
            best = sum;
            at = other;
        }
    }
    double step = std::min(a.size(), b.size()) / 4;
    for (int round = 0; round < 8; ++round, step /= 2) {
        for (int axis = 0; axis < 3; ++axis) {
            for (const double sign : {-1.0, 1.0}) {
                Vec3 other = at;
                other[axis] += sign * step;
                if (const double sum = sum_at(other); sum > best) {
                    best = sum;
                    at = other;
                }
            }
        }
    }
    return best;
}

} // namespace

Separation separation(const Element& a, const Element& b, const Pose& pose_a, const Pose& pose_b) {
    const Placed first(a, pose_a), second(b, pose_b);
    const Cores cores = distance_of_cores(first, second);
    const double radii = first.radius() + second.radius();
    const double slack = rounding_of_distances * (first.size() + second.size() + cores.high);
    if (const double low = cores.low - radii - slack; low > 0) {
        return {.low = low, .depth = 0};
    }
    if (cores.high > 0) {
        return {.low = 0, .depth = std::max(0.0, radii - cores.high - slack)};
    }
    return {.low = 0, .depth = std::max(0.0, depth_of(first, second, cores.in_first) - slack)};
}

} // namespace foam::inline collision
