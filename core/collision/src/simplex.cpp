#include "simplex.hpp"

#include <limits>
#include <optional>

namespace foam::inline collision {
namespace {

using Weights = std::array<double, 4>;
using Corners = std::array<std::size_t, 4>;

Vec3 point_of(const Simplex& simplex, const Weights& weights) {
    Vec3 point;
    for (std::size_t i = 0; i < simplex.size; ++i) {
        point += simplex.corners[i].point * weights[i];
    }
    return point;
}

/// Returns the weights of the point closest to the origin on the line, plane or whole space through some corners;
/// nothing if it does not lie between them, or they are degenerate.
std::optional<Weights> weights_within(const Simplex& simplex, const Corners& of, std::size_t count) {
    const Vec3& a = simplex.corners[of[0]].point;
    Weights weights{};
    if (count == 1) {
        weights[of[0]] = 1;
        return weights;
    }
    const Vec3 u = simplex.corners[of[1]].point - a;
    if (count == 2) {
        const double t = -dot(a, u), whole = dot(u, u);
        if (!(t > 0 && t < whole)) {
            return {};
        }
        weights[of[1]] = t / whole;
        weights[of[0]] = 1 - weights[of[1]];
        return weights;
    }
    const Vec3 v = simplex.corners[of[2]].point - a;
    if (count == 3) {
        const Vec3 normal = cross(u, v);
        const double area = dot(normal, normal);
        const double s = -dot(cross(a, v), normal), t = -dot(cross(u, a), normal);
        if (!(s > 0 && t > 0 && s + t < area)) {
            return {};
        }
        weights[of[1]] = s / area;
        weights[of[2]] = t / area;
        weights[of[0]] = 1 - weights[of[1]] - weights[of[2]];
        return weights;
    }
    const Vec3 w = simplex.corners[of[3]].point - a;
    const double volume = dot(u, cross(v, w)), sign = volume < 0 ? -1 : 1;
    const double r = -sign * dot(a, cross(v, w)), s = -sign * dot(u, cross(a, w)), t = -sign * dot(u, cross(v, a));
    if (!(r > 0 && s > 0 && t > 0 && r + s + t < sign * volume)) {
        return {};
    }
    weights[of[1]] = r / (sign * volume);
    weights[of[2]] = s / (sign * volume);
    weights[of[3]] = t / (sign * volume);
    weights[of[0]] = 1 - weights[of[1]] - weights[of[2]] - weights[of[3]];
    return weights;
}

} // namespace

Vec3 Simplex::closest() {
    Weights best{};
    Vec3 nearest;
    double least = std::numeric_limits<double>::infinity();
    for (unsigned set = 1; set < 1U << size; ++set) { // of corners
        Corners of{};
        std::size_t count = 0;
        for (std::size_t i = 0; i < size; ++i) {
            if (set >> i & 1U) {
                of[count++] = i;
            }
        }
        const std::optional<Weights> found = weights_within(*this, of, count);
        if (!found) {
            continue;
        }
        const Vec3 point = count == 4 ? Vec3{} : point_of(*this, *found);
        if (const double length = squared_norm(point); length < least) {
            least = length;
            nearest = point;
            best = *found;
        }
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size; ++i) {
        if (best[i] > 0) {
            corners[kept] = corners[i];
            weights[kept++] = best[i];
        }
    }
    size = kept;
    return nearest;
}

Vec3 Simplex::in_first() const {
    Vec3 point;
    for (std::size_t i = 0; i < size; ++i) {
        point += corners[i].in_first * weights[i];
    }
    return point;
}

} // namespace foam::inline collision
