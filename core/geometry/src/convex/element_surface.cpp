#include "convex/element_surface.hpp"

#include <foam/geometry/vector.hpp>

#include <functional>
#include <numbers>

namespace foam::inline geometry {
namespace {

using std::numbers::pi;

/// A part of a surface: points for two numbers between 0 and 1, uniform by area.
struct Patch {
    double area;
    std::function<ElementPoint(double, double)> at;
};

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

void add_cylinder_patches(double half, double radius, std::vector<Patch>& patches) {
    patches.push_back({4 * pi * radius * half, [=](double s, double t) {
                           const Vec3 n{std::cos(2 * pi * t), std::sin(2 * pi * t), 0};
                           return ElementPoint{n * radius + Vec3{0, 0, half * (2 * s - 1)}, n, 0};
                       }});
    for (const double side : {-1.0, 1.0}) {
        patches.push_back(
            {pi * radius * radius, [=](double s, double t) {
                 const double across = radius * std::sqrt(s);
                 return ElementPoint{
                     {across * std::cos(2 * pi * t), across * std::sin(2 * pi * t), side * half}, {0, 0, side}, 0};
             }});
    }
}

void add_hull_patches(const Mesh& mesh, std::vector<Patch>& patches) {
    for (const auto& [ia, ib, ic] : mesh.triangles) {
        const Vec3 a = mesh.vertices[ia], u = mesh.vertices[ib] - a, v = mesh.vertices[ic] - a, n = cross(u, v);
        patches.push_back({norm(n) / 2, [=](double s, double t) {
                               const double root = std::sqrt(s);
                               return ElementPoint{a + u * (root * (1 - t)) + v * (root * t), normalized(n), 0};
                           }});
    }
}

/// Points of a lattice by the golden ratio, each for the same share of the area.
void add_points(const Patch& patch, std::size_t count, std::vector<ElementPoint>& points) {
    double second = 0.5;
    for (std::size_t k = 0; k < count; ++k) {
        second += 0.6180339887498949;
        second -= second >= 1 ? 1 : 0;
        ElementPoint p = patch.at((static_cast<double>(k) + 0.5) / static_cast<double>(count), second);
        p.area = patch.area / static_cast<double>(count);
        points.push_back(p);
    }
}

/// The ball's surface, each octant moved to its corner of the box.
void add_corners(const Vec3& half, double radius, std::size_t count, std::vector<ElementPoint>& points) {
    for (const Vec3& n : fibonacci_directions(count)) {
        const Vec3 corner{std::copysign(half.x, n.x), std::copysign(half.y, n.y), std::copysign(half.z, n.z)};
        points.push_back({corner + n * radius, n, 4 * pi * radius * radius / static_cast<double>(count)});
    }
}

void add_places(const Element& e, std::vector<ElementPoint>& points) {
    if (e.kind == Element::Kind::hull) {
        Vec3 middle{};
        for (const Vec3& v : e.hull->surface.vertices) {
            middle += v / static_cast<double>(e.hull->surface.vertices.size());
        }
        for (const Vec3& v : e.hull->surface.vertices) {
            points.push_back({v, normalized(v - middle), 0});
        }
    } else if (e.kind == Element::Kind::cylinder) {
        for (int k = 0; k < 64; ++k) {
            const double angle = 2 * pi * k / 64;
            const Vec3 rim{e.radius * std::cos(angle), e.radius * std::sin(angle), e.half.z};
            points.push_back({rim, normalized(rim), 0});
            points.push_back({{rim.x, rim.y, -rim.z}, normalized({rim.x, rim.y, -rim.z}), 0});
        }
    } else {
        for (int k = 0; k < 8; ++k) {
            const Vec3 n = Vec3{k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0} / std::sqrt(3.0);
            points.push_back(
                {{std::copysign(e.half.x, n.x) + e.radius * n.x, std::copysign(e.half.y, n.y) + e.radius * n.y,
                  std::copysign(e.half.z, n.z) + e.radius * n.z},
                 n,
                 0});
        }
    }
}

} // namespace

std::vector<ElementPoint> surface_points(const Element& e, std::size_t count) {
    std::vector<Patch> patches;
    double sphere = 0;
    if (e.kind == Element::Kind::cylinder) {
        add_cylinder_patches(e.half.z, e.radius, patches);
    } else if (e.kind == Element::Kind::hull) {
        add_hull_patches(e.hull->surface, patches);
    } else {
        add_box_patches(e.half, e.radius, patches);
        sphere = 4 * pi * e.radius * e.radius;
    }
    double area = sphere;
    for (const Patch& patch : patches) {
        area += patch.area;
    }
    const auto share = [&](double of) {
        return std::max<std::size_t>(1, static_cast<std::size_t>(std::round(static_cast<double>(count) * of / area)));
    };
    std::vector<ElementPoint> points;
    for (const Patch& patch : patches) {
        if (patch.area > 0) {
            add_points(patch, share(patch.area), points);
        }
    }
    if (sphere > 0) {
        add_corners(e.half, e.radius, share(sphere), points);
    }
    add_places(e, points);
    for (ElementPoint& p : points) {
        p.point = e.pose * p.point;
        p.normal = e.pose.rotate(p.normal);
    }
    return points;
}

} // namespace foam::geometry
