// Spheres, capsules, boxes and swept boxes: a box, a segment or a point, widened by a radius.
#include "convex/enclosing_mesh.hpp"
#include "convex/kind.hpp"
#include "convex/outside_box.hpp"
#include "convex/reach.hpp"

#include <foam/geometry/vector.hpp>

#include <array>
#include <numbers>

namespace foam::inline geometry {
namespace {

using std::numbers::pi;

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

/// Returns the sum of the box and a polyhedron around the ball: the hull of the polyhedron at each corner of the box.
Mesh swept_box_mesh(const Vec3& half, double radius, int segments) {
    std::vector<Vec3> points;
    for (const Vec3& v : capsule_mesh(radius, 0, segments).vertices) {
        for (int corner = 0; corner < 8; ++corner) {
            points.push_back(
                v + Vec3{corner & 1 ? half.x : -half.x, corner & 2 ? half.y : -half.y, corner & 4 ? half.z : -half.z});
        }
    }
    return convex_hull(points)->surface;
}

/// The faces of a box, and what a radius makes of its edges: quarters of cylinders.
void add_box_patches(const Vec3& half, double radius, std::vector<Patch>& patches) {
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (const double side : {-1.0, 1.0}) {
            patches.push_back({4 * half[u] * half[v], [=](double s, double t) {
                                   Vec3 p{}, n{};
                                   n[axis] = side;
                                   p[axis] = side * (half[axis] + radius);
                                   p[u] = half[u] * (2 * s - 1);
                                   p[v] = half[v] * (2 * t - 1);
                                   return ElementPoint{p, n, 0};
                               }});
            for (const double other : {-1.0, 1.0}) { // the edge along `axis` at the corner (side, other) of u and v
                patches.push_back({2 * half[axis] * radius * pi / 2, [=](double s, double t) {
                                       Vec3 p{}, n{};
                                       n[u] = side * std::cos(t * pi / 2);
                                       n[v] = other * std::sin(t * pi / 2);
                                       p[axis] = half[axis] * (2 * s - 1);
                                       p[u] = side * half[u] + radius * n[u];
                                       p[v] = other * half[v] + radius * n[v];
                                       return ElementPoint{p, n, 0};
                                   }});
            }
        }
    }
}

/// The ball's surface, each octant moved to its corner of the box.
void add_corners(const Vec3& half, double radius, std::size_t count, std::vector<ElementPoint>& points) {
    for (const Vec3& n : fibonacci_directions(count)) {
        const Vec3 corner{std::copysign(half.x, n.x), std::copysign(half.y, n.y), std::copysign(half.z, n.z)};
        points.push_back({corner + n * radius, n, 4 * pi * radius * radius / static_cast<double>(count)});
    }
}

Element box_around(Element e, std::span<const Vec3> points, double room) {
    for (int axis = 0; axis < 3; ++axis) {
        const Box box = own_box(e, points, room); // a move along one axis rounds along the others
        reach_along(e, axis, box.low[axis], box.high[axis]);
    }
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

Element thicker_or_longer(const Element& e, std::span<const Vec3> points, double room) {
    const Element a = thicker(e, points, room), b = longer(e, points, room);
    return volume(b) < volume(a) ? b : a;
}

/// What the four kinds have in common. Numbers that a kind does not have are 0.
class Widened : public ConvexKind {
public:
    using ConvexKind::ConvexKind;

    double signed_distance(const Element& e, const Vec3& p) const final {
        const Vec3 out = outside_box(e.half, p);
        if (out != Vec3{}) {
            return norm(out) - e.radius;
        }
        return std::max({std::abs(p.x) - e.half.x, std::abs(p.y) - e.half.y, std::abs(p.z) - e.half.z}) - e.radius;
    }
    Vec3 support(const Element& e, const Vec3& d) const final {
        return Vec3{std::copysign(e.half.x, d.x), std::copysign(e.half.y, d.y), std::copysign(e.half.z, d.z)} +
               normalized(d) * e.radius;
    }
    Box bounds(const Element& e) const final {
        Vec3 reach;
        for (int axis = 0; axis < 3; ++axis) {
            const Vec3& row = e.pose.rotation[static_cast<std::size_t>(axis)];
            reach[axis] = std::abs(row.x) * e.half.x + std::abs(row.y) * e.half.y + std::abs(row.z) * e.half.z +
                          e.radius * norm(row);
        }
        return Box::about(e.pose.translation, reach);
    }
    bool is_widened() const override { return true; }
    std::vector<ElementPoint> surface_points(const Element& e, std::size_t count) const final;
    Element grown(Element e, double length, double (*sum)(double, double)) const override {
        e.radius = sum(e.radius, length);
        return e;
    }
};

std::vector<ElementPoint> Widened::surface_points(const Element& e, std::size_t count) const {
    std::vector<Patch> patches;
    add_box_patches(e.half, e.radius, patches);
    const double ball = 4 * pi * e.radius * e.radius;
    const double area = area_of(patches, ball);
    std::vector<ElementPoint> points;
    add_points(patches, area, count, points);
    if (ball > 0) {
        add_corners(e.half, e.radius, share_of(count, ball, area), points);
    }
    for (int k = 0; k < 8; ++k) { // the corners
        const Vec3 n = Vec3{k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0} / std::sqrt(3.0);
        points.push_back(
            {{std::copysign(e.half.x, n.x) + e.radius * n.x, std::copysign(e.half.y, n.y) + e.radius * n.y,
              std::copysign(e.half.z, n.z) + e.radius * n.z},
             n,
             0});
    }
    return points;
}

class SphereKind final : public Widened {
public:
    using Widened::Widened;

    bool has_known_surface() const override { return true; }
    double volume(const Element& e) const override { return 4.0 / 3 * pi * e.radius * e.radius * e.radius; }
    std::optional<Vec3> second_moments(const Element& e) const override {
        const double ball = pi * e.radius * e.radius * e.radius * 4 / 3;
        return Vec3{1, 1, 1} * (ball * e.radius * e.radius / 5);
    }
    MaybePart inside_along(const Element& e, const Vec3& o, const Vec3& d) const override {
        return in_ball(o, d, e.radius);
    }
    Mesh mesh(const Element& e, int segments) const override { return capsule_mesh(e.radius, 0, segments); }
    Element enlarged(const Element& e, std::span<const Vec3> points, double room) const override {
        return thicker(e, points, room);
    }
};

class CapsuleKind final : public Widened {
public:
    using Widened::Widened;

    bool has_known_surface() const override { return true; }
    double volume(const Element& e) const override {
        return pi * e.radius * e.radius * (2 * e.half.z + 4.0 / 3 * e.radius);
    }
    std::optional<Vec3> second_moments(const Element& e) const override {
        const double r = e.radius, h = 2 * e.half.z, disc = pi * r * r, ball = disc * r * 4 / 3;
        const double across = disc * h * r * r / 4 + ball * r * r / 5;
        return Vec3{across, across, disc * h * h * h / 12 + ball * (h * h / 4 + 3 * h * r / 8 + r * r / 5)};
    }
    MaybePart inside_along(const Element& e, const Vec3& o, const Vec3& d) const override {
        return in_capsule(o, d, e.radius, e.half.z);
    }
    Mesh mesh(const Element& e, int segments) const override { return capsule_mesh(e.radius, e.half.z, segments); }
    Element enlarged(const Element& e, std::span<const Vec3> points, double room) const override {
        return thicker_or_longer(e, points, room);
    }
};

class BoxKind final : public Widened {
public:
    using Widened::Widened;

    double volume(const Element& e) const override { return 8 * e.half.x * e.half.y * e.half.z; }
    std::optional<Vec3> second_moments(const Element& e) const override {
        const Vec3 size = e.half * 2;
        return Vec3{size.x * size.x, size.y * size.y, size.z * size.z} * (volume(e) / 12);
    }
    MaybePart inside_along(const Element& e, const Vec3& o, const Vec3& d) const override {
        return in_box(o, d, e.half);
    }
    Mesh mesh(const Element& e, int) const override { return box_mesh(e.half); }
    bool has_flat_faces() const override { return true; }
    bool is_widened() const override { return false; }
    Element grown(Element e, double length, double (*sum)(double, double)) const override {
        e.half = {sum(e.half.x, length), sum(e.half.y, length), sum(e.half.z, length)};
        return e;
    }
    Element enlarged(const Element& e, std::span<const Vec3> points, double room) const override {
        return box_around(e, points, room);
    }
};

class SweptBoxKind final : public Widened {
public:
    using Widened::Widened;

    double volume(const Element& e) const override {
        const Vec3& h = e.half;
        const double r = e.radius;
        // Steiner's formula: the box, its faces, its edges and its corners, widened.
        return 8 * h.x * h.y * h.z + 8 * (h.x * h.y + h.y * h.z + h.z * h.x) * r + 2 * pi * (h.x + h.y + h.z) * r * r +
               4.0 / 3 * pi * r * r * r;
    }
    MaybePart inside_along(const Element& e, const Vec3& o, const Vec3& d) const override {
        return in_swept_box(o, d, e.half, e.radius);
    }
    Mesh mesh(const Element& e, int segments) const override {
        return e.radius > 0 ? swept_box_mesh(e.half, e.radius, segments) : box_mesh(e.half);
    }
    Element enlarged(const Element& e, std::span<const Vec3> points, double room) const override {
        return thicker_or_longer(e, points, room);
    }
};

constexpr std::array<std::string_view, 1> of_sphere{"radius"}, of_box{"size"};
constexpr std::array<std::string_view, 2> of_capsule{"length", "radius"}, of_swept_box{"size", "radius"};
constexpr SphereKind sphere("sphere", of_sphere);
constexpr CapsuleKind capsule("capsule", of_capsule);
constexpr BoxKind box("box", of_box);
constexpr SweptBoxKind swept_box("swept_box", of_swept_box);

} // namespace

extern constinit const ConvexKind* const sphere_kind = &sphere;
extern constinit const ConvexKind* const capsule_kind = &capsule;
extern constinit const ConvexKind* const box_kind = &box;
extern constinit const ConvexKind* const swept_box_kind = &swept_box;

} // namespace foam::inline geometry
