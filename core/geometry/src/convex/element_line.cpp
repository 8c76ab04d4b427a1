// Where a line is inside an element.
#include "convex/convex_line.hpp"

#include <array>

namespace foam::inline geometry {
namespace {

/// Returns where the line is within `radius` of the box [-half, half]. Along each axis the places where it enters and
/// leaves the slab cut it into parts. On a part the squared distance from the box is one quadratic, a sum over the axes
/// whose slab the part is outside of.
MaybePart in_swept_box(const Vec3& o, const Vec3& d, const Vec3& half, double radius) {
    constexpr double without_end = std::numeric_limits<double>::infinity();
    if (!in_box(o, d, half + Vec3{radius, radius, radius})) {
        return {};
    }
    std::array<double, 8> cuts;
    cuts.fill(without_end);
    cuts[0] = -without_end;
    std::size_t count = 1;
    for (int axis = 0; axis < 3; ++axis) {
        if (d[axis] != 0) {
            cuts[count++] = (-half[axis] - o[axis]) / d[axis];
            cuts[count++] = (half[axis] - o[axis]) / d[axis];
        }
    }
    std::sort(cuts.begin(), cuts.end());
    MaybePart result;
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
        const double from = cuts[k], to = cuts[k + 1];
        if (!(from < to)) {
            continue;
        }
        const double inside = from == -without_end ? (to == without_end ? 0 : to - 1 - std::abs(to))
                              : to == without_end  ? from + 1 + std::abs(from)
                                                   : from + (to - from) / 2;
        double a = 0, b = 0, c = -radius * radius;
        for (int axis = 0; axis < 3; ++axis) {
            const double at = o[axis] + inside * d[axis];
            if (std::abs(at) > half[axis]) {
                const double away = o[axis] - std::copysign(half[axis], at);
                a += d[axis] * d[axis];
                b += away * d[axis];
                c += away * away;
            }
        }
        result = around(result, intersection(in_quadric(a, b, c), LinePart{from, to}));
    }
    return result;
}

MaybePart in_hull(const Vec3& o, const Vec3& d, const Polytope& hull) {
    constexpr double without_end = std::numeric_limits<double>::infinity();
    LinePart part{-without_end, without_end};
    for (const Polytope::Face& face : hull.faces) {
        const double slope = dot(face.normal, d), room = face.offset - dot(face.normal, o);
        if (slope > 0) {
            part.leave = std::min(part.leave, room / slope);
        } else if (slope < 0) {
            part.enter = std::max(part.enter, room / slope);
        } else if (room < 0) {
            return {};
        }
    }
    return part.enter < part.leave ? MaybePart(part) : MaybePart();
}

} // namespace

std::optional<LinePart> inside_along(const Element& e, const Vec3& origin, const Vec3& direction) {
    const Pose to_local = e.pose.inverse();
    const Vec3 o = to_local.rotate(origin - e.pose.translation), d = to_local.rotate(direction);
    switch (e.kind) {
    case Element::Kind::sphere:
        return in_ball(o, d, e.radius);
    case Element::Kind::capsule:
        return in_capsule(o, d, e.radius, e.half.z);
    case Element::Kind::cylinder:
        return in_cylinder(o, d, e.radius, e.half.z);
    case Element::Kind::box:
        return in_box(o, d, e.half);
    case Element::Kind::swept_box:
        return in_swept_box(o, d, e.half, e.radius);
    case Element::Kind::hull:
        break;
    }
    return in_hull(o, d, *e.hull);
}

} // namespace foam::geometry
