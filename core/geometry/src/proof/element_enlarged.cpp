#include "proof/element_grown.hpp"
#include "proof/element_growth.hpp"
#include "convex/outside_box.hpp"

namespace foam::inline geometry {
namespace {

Vec3 to_own_frame(const Element& e, const Vec3& p) {
    const auto& r = e.pose.rotation;
    const Vec3 v = p - e.pose.translation;
    return r[0] * v.x + r[1] * v.y + r[2] * v.z;
}

/// Makes the core reach from `low` to `high` along an axis as well.
void reach_along(Element& e, int axis, double low, double high) {
    const double from = std::min(low, -e.half[axis]), to = std::max(high, e.half[axis]);
    if (from < -e.half[axis] || to > e.half[axis]) {
        Vec3 middle{};
        middle[axis] = (from + to) / 2;
        // Rounded outwards: the ends are off by no more than the rounding of the pose.
        e.half[axis] = (to - from) / 2 * (1 + 4e-16) + 4e-16 * (norm(e.pose.translation) + std::abs(middle[axis]));
        e.pose.translation += e.pose.rotate(middle);
    }
}

/// Returns the box around all within `room` of the points, in the element's frame.
Box own_box(const Element& e, std::span<const Vec3> points, double room) {
    Box box;
    for (const Vec3& p : points) {
        const Vec3 q = to_own_frame(e, p);
        box.add(q - Vec3{room, room, room});
        box.add(q + Vec3{room, room, room});
    }
    return box;
}

Element box_around(Element e, std::span<const Vec3> points, double room) {
    for (int axis = 0; axis < 3; ++axis) {
        const Box box = own_box(e, points, room); // a move along one axis rounds along the others
        reach_along(e, axis, box.low[axis], box.high[axis]);
    }
    return e;
}

Element cylinder_around(Element e, std::span<const Vec3> points, double room) {
    for (const Vec3& p : points) {
        const Vec3 q = to_own_frame(e, p);
        e.radius = std::max(e.radius, std::hypot(q.x, q.y) + room);
    }
    const Box box = own_box(e, points, room);
    reach_along(e, 2, box.low.z, box.high.z);
    return e;
}

/// A sphere, capsule or swept box with a larger radius.
Element thicker(Element e, std::span<const Vec3> points, double room) {
    for (const Vec3& p : points) {
        e.radius = std::max(e.radius, norm(outside_box(e.half, to_own_frame(e, p))) + room);
    }
    return e;
}

/// A capsule or swept box with a longer core where its radius then suffices, else thicker.
Element longer(Element e, std::span<const Vec3> points, double room) {
    for (const Vec3& p : points) {
        const Vec3 q = to_own_frame(e, p), out = outside_box(e.half, q);
        if (norm(out) + room <= e.radius) {
            continue;
        }
        int axis = 2;
        if (e.kind == Element::Kind::swept_box) {
            const Vec3 size{std::abs(out.x), std::abs(out.y), std::abs(out.z)};
            axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        }
        Vec3 aside = out;
        aside[axis] = 0;
        const double radius = e.radius - room, left = radius * radius - squared_norm(aside);
        if (left > 0) {
            const double end = std::abs(q[axis]) - std::sqrt(left) * (1 - 1e-15) + room;
            reach_along(e, axis, q[axis] < 0 ? -end : 0, q[axis] > 0 ? end : 0);
        }
    }
    return thicker(e, points, room);
}

Element hull_around(Element e, std::span<const Vec3> points, double room) {
    const Polytope& hull = *e.hull;
    std::vector<double> lengths(hull.faces.size(), 0.0);
    std::vector<Vec3> own, all = hull.surface.vertices;
    for (const Vec3& p : points) {
        own.push_back(to_own_frame(e, p));
    }
    for (std::size_t f = 0; f < hull.faces.size(); ++f) {
        for (const Vec3& p : own) {
            lengths[f] = std::max(lengths[f], dot(hull.faces[f].normal, p) - hull.faces[f].offset);
        }
        lengths[f] += room;
    }
    all.insert(all.end(), own.begin(), own.end());
    const auto with_points = convex_hull(all);
    const auto moved = with_faces_moved(hull, lengths, own, room);
    e.hull = moved;
    if (!moved || with_points->surface.vertices.size() <= hull.surface.vertices.size()) {
        const auto wider = with_room(*with_points, room);
        e.hull = !moved || signed_volume(wider->surface) < signed_volume(moved->surface) ? wider : moved;
    }
    return e;
}

} // namespace

Element enlarged(const Element& e, std::span<const Vec3> points, double room) {
    switch (e.kind) {
    case Element::Kind::sphere:
        return thicker(e, points, room);
    case Element::Kind::capsule:
    case Element::Kind::swept_box: {
        const Element a = thicker(e, points, room), b = longer(e, points, room);
        return volume(b) < volume(a) ? b : a;
    }
    case Element::Kind::cylinder:
        return cylinder_around(e, points, room);
    case Element::Kind::hull:
        return hull_around(e, points, room);
    case Element::Kind::box:
        break;
    }
    return box_around(e, points, room);
}

double added_volume(const Element& e, std::span<const Vec3> points) {
    if (e.kind != Element::Kind::hull) {
        return volume(enlarged(e, points, 0)) - volume(e);
    }
    // The pyramids from a point to the triangles that it sees.
    const Mesh& mesh = e.hull->surface;
    double most = 0;
    for (const Vec3& p : points) {
        const Vec3 q = to_own_frame(e, p);
        double sum = 0;
        for (const auto& [a, b, c] : mesh.triangles) {
            const Vec3& at = mesh.vertices[a];
            sum += std::max(0.0, dot(cross(mesh.vertices[b] - at, mesh.vertices[c] - at), q - at));
        }
        most = std::max(most, sum / 6);
    }
    return most;
}

} // namespace foam::geometry
