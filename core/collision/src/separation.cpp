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
    Placed(const Element& element, const Pose& link) : element_(element), pose_(link * element.pose) {}

    /// Returns the radius around the core.
    double radius() const { return has_round_edges() ? element_.radius : 0; }

    /// Returns the farthest point of the core along a direction.
    Vec3 support(const Vec3& direction) const {
        const std::array<Vec3, 3>& r = pose_.rotation;
        const Vec3 d = r[0] * direction.x + r[1] * direction.y + r[2] * direction.z; // in the element's frame
        return pose_ * own_support(d);
    }

    /// Returns a point in the middle.
    Vec3 middle() const {
        if (!element_.hull) {
            return pose_.translation;
        }
        Box box;
        for (const Vec3& vertex : element_.hull->surface.vertices) {
            box.add(vertex);
        }
        return pose_ * box.center();
    }

    /// Returns the radius of a ball around the point that lies in the element; negative if the point does not.
    double depth_at(const Vec3& point) const {
        const std::array<Vec3, 3>& r = pose_.rotation;
        const Vec3 away = point - pose_.translation;
        return own_depth(r[0] * away.x + r[1] * away.y + r[2] * away.z);
    }

    double size() const { return norm(element_.half) + element_.radius + hull_size(); }

private:
    bool has_round_edges() const {
        return element_.kind == Element::Kind::sphere || element_.kind == Element::Kind::capsule ||
               element_.kind == Element::Kind::swept_box;
    }

    double hull_size() const {
        double size = 0;
        if (element_.hull) {
            for (const Vec3& vertex : element_.hull->surface.vertices) {
                size = std::max(size, norm(vertex));
            }
        }
        return size;
    }

    Vec3 own_support(const Vec3& d) const {
        if (element_.kind == Element::Kind::hull) {
            const std::vector<Vec3>& vertices = element_.hull->surface.vertices;
            return *std::max_element(vertices.begin(), vertices.end(),
                                     [&](const Vec3& a, const Vec3& b) { return dot(a, d) < dot(b, d); });
        }
        Vec3 corner{std::copysign(element_.half.x, d.x), std::copysign(element_.half.y, d.y),
                    std::copysign(element_.half.z, d.z)};
        if (element_.kind == Element::Kind::cylinder) {
            const double across = std::hypot(d.x, d.y);
            corner.x = across > 0 ? element_.radius * d.x / across : 0;
            corner.y = across > 0 ? element_.radius * d.y / across : 0;
        }
        return corner;
    }

    double own_depth(const Vec3& p) const {
        const Vec3 beyond{std::abs(p.x) - element_.half.x, std::abs(p.y) - element_.half.y,
                          std::abs(p.z) - element_.half.z};
        switch (element_.kind) {
        case Element::Kind::hull: {
            double least = std::numeric_limits<double>::infinity();
            for (const Polytope::Face& face : element_.hull->faces) {
                least = std::min(least, face.offset - dot(face.normal, p));
            }
            return least;
        }
        case Element::Kind::cylinder:
            return std::min(element_.radius - std::hypot(p.x, p.y), -beyond.z);
        case Element::Kind::sphere:
        case Element::Kind::capsule:
        case Element::Kind::box:
        case Element::Kind::swept_box:
            break;
        }
        const double inside = -std::max({beyond.x, beyond.y, beyond.z});
        if (inside >= 0) {
            return inside + radius();
        }
        return radius() -
               norm({std::max(beyond.x, 0.0), std::max(beyond.y, 0.0), std::max(beyond.z, 0.0)});
    }

    const Element& element_;
    Pose pose_;
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
