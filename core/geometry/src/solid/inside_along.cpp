// The parts of a line inside a surface, open or closed.
#include "mesh/mesh_part.hpp"

#include <foam/base/cancellation.hpp>

#include <numbers>

namespace foam::inline geometry {
namespace {

/// Share of the extent below which the winding number is linear over a part of a line.
constexpr double resolution = 1.0 / 16;
/// Distance from one half at the middle of a short part beyond which the whole part is on one side of it.
constexpr double clear = 0.25;
/// Accuracy of winding numbers by expansion.
constexpr double accuracy = 2e-3;

double squared_distance(const BvhNode& node, const Box& region) {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double apart = std::max({node.low[axis] - region.high[axis], region.low[axis] - node.high[axis], 0.0});
        sum += apart * apart;
    }
    return sum;
}

/// Clips the line to the box.
bool clip(const Box& box, const Vec3& origin, const Vec3& direction, double& from, double& to) {
    from = -std::numeric_limits<double>::infinity();
    to = -from;
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0) {
            if (!(box.low[axis] <= origin[axis] && origin[axis] <= box.high[axis])) {
                return false;
            }
            continue;
        }
        const double a = (box.low[axis] - origin[axis]) / direction[axis];
        const double b = (box.high[axis] - origin[axis]) / direction[axis];
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
    }
    return from < to;
}

} // namespace

/// Returns a bound: from distance d, a surface of area A has a solid angle of at most A/d², and a single triangle one
/// of at most 2π.
double MeshPart::winding_at_most(const Box& region, double enough) const {
    constexpr double near_share = 1.0 / 64; // nodes that may contribute more are opened
    const std::vector<BvhNode>& nodes = bvh_.nodes();
    const std::vector<Moments>& moments = this->moments();
    double sum = 0;
    std::array<std::uint32_t, Bvh::max_depth> stack;
    std::size_t size = 0;
    stack[size] = 0;
    size += !nodes.empty();
    while (size > 0 && sum < enough) {
        const std::uint32_t n = stack[--size];
        const BvhNode& node = nodes[n];
        const double d2 = squared_distance(node, region);
        const double most = d2 > 0 ? moments[n].area / (4 * std::numbers::pi * d2) : 1e300;
        if (most <= near_share * enough) {
            sum += most;
        } else if (node.leaf()) {
            sum += std::min(most, 0.5 * node.count);
        } else {
            stack[size++] = node.first + 1;
            stack[size++] = node.first;
        }
    }
    return sum < enough ? sum : std::numeric_limits<double>::infinity();
}

void MeshPart::inside_along(const Vec3& origin, const Vec3& direction, std::span<const Crossing> crossings,
                            std::span<const Solid::Interval> parts, std::vector<Solid::Interval>& result) const {
    // The surface and its closing surface lie within the box: nothing outside it is inside.
    double from = 0, to = 0;
    if (!clip(box_, origin, direction, from, to)) {
        return;
    }
    for (const Solid::Interval& part : parts) {
        const double enter = std::max(from, part.enter), leave = std::min(to, part.leave);
        if (enter < leave) {
            inside_part(origin, direction, enter, leave, crossings, result);
        }
    }
}

void MeshPart::inside_part(const Vec3& origin, const Vec3& direction, double from, double to,
                           std::span<const Crossing> crossings, std::vector<Solid::Interval>& result) const {
    Box line;
    line.add(origin + from * direction);
    line.add(origin + to * direction);
    const bool holes_matter = !(closing_->winding_at_most(line, 0.5) < 0.5);
    int winding = 0; // of the surface and its closing surface
    const auto stretch = [&](double enter, double leave) {
        if (enter < leave && holes_matter) {
            inside_stretch(origin, direction, enter, leave, winding, result);
        } else if (enter < leave && winding > 0) {
            result.push_back({enter, leave});
        }
    };
    for (const Crossing& crossing : crossings) {
        const double next = std::clamp(crossing.t, from, to);
        stretch(from, next);
        from = next;
        winding += crossing.change;
    }
    stretch(from, to);
}

/// Halves the stretch until holes cannot matter or it is short.
void MeshPart::inside_stretch(const Vec3& origin, const Vec3& direction, double enter, double leave, int winding,
                              std::vector<Solid::Interval>& result) const {
    check_cancelled(); // a line may have thousands of stretches
    const double unit = norm(direction), shortest = resolution * box_.diagonal() / unit;
    const auto above_half = [&](const Vec3& p) { return winding - closing_->winding_by_expansion(p).value - 0.5; };
    const auto take_short = [&](const Vec3& p, double half, const Solid::Interval& s) {
        const double at_middle = above_half(p);
        if (std::abs(at_middle) > clear) {
            if (at_middle > 0) {
                result.push_back(s);
            }
            return;
        }
        // Linear through the values at the quarters, as the ends may lie on the closing surface.
        const double near = above_half(p - half / 2 * direction), far = above_half(p + half / 2 * direction);
        const double slope = (far - near) / half, middle = (s.enter + s.leave) / 2;
        const double zero = slope == 0 ? middle : std::clamp(middle - (near + far) / 2 / slope, s.enter, s.leave);
        const Solid::Interval inside{slope > 0 ? zero : s.enter, slope < 0 ? zero : s.leave};
        if (inside.enter < inside.leave && (slope != 0 || near > 0)) {
            result.push_back(inside);
        }
    };
    std::array<Solid::Interval, 64> waiting; // there are few halvings
    std::size_t size = 0;
    waiting[size++] = {enter, leave};
    while (size > 0) {
        const Solid::Interval s = waiting[--size];
        const double middle = (s.enter + s.leave) / 2, half = (s.leave - s.enter) / 2;
        const Vec3 p = origin + middle * direction;
        if (2 * half <= shortest) {
            take_short(p, half, s);
            continue;
        }
        const Variation closing = closing_->winding_around(p, half * unit, 1);
        const double inside = winding - closing.value - 0.5;
        if (!(std::abs(inside) > closing.variation + accuracy)) {
            waiting[size++] = {middle, s.leave};
            waiting[size++] = {s.enter, middle};
        } else if (inside > 0) {
            result.push_back(s);
        }
    }
}

} // namespace foam::geometry
