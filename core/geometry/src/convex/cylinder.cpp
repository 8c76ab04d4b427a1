// Cylinders: a disc, swept along its axis.
#include "convex/enclosing_mesh.hpp"
#include "convex/kind.hpp"
#include "convex/reach.hpp"

#include <foam/base/hypot.hpp>

#include <array>
#include <numbers>

namespace foam::inline geometry {
namespace {

using std::numbers::pi;

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

Element cylinder_around(Element e, std::span<const Vec3> points, double room) {
    for (const Vec3& p : points) {
        const Vec3 q = to_own_frame(e, p);
        e.radius = std::max(e.radius, foam::hypot(q.x, q.y) + room);
    }
    const Box box = own_box(e, points, room);
    reach_along(e, 2, box.low.z, box.high.z);
    return e;
}

class CylinderKind final : public ConvexKind {
public:
    using ConvexKind::ConvexKind;

    double signed_distance(const Element& e, const Vec3& p) const override {
        const double across = foam::hypot(p.x, p.y) - e.radius, along = std::abs(p.z) - e.half.z;
        return std::max(across, along) <= 0 ? std::max(across, along)
                                            : foam::hypot(std::max(across, 0.0), std::max(along, 0.0));
    }
    Vec3 support(const Element& e, const Vec3& d) const override {
        return Vec3{0, 0, std::copysign(e.half.z, d.z)} + normalized({d.x, d.y, 0}) * e.radius;
    }
    Box bounds(const Element& e) const override {
        Vec3 reach;
        for (int axis = 0; axis < 3; ++axis) {
            const Vec3& row = e.pose.rotation[static_cast<std::size_t>(axis)];
            reach[axis] = std::abs(row.z) * e.half.z + e.radius * foam::hypot(row.x, row.y);
        }
        return Box::about(e.pose.translation, reach);
    }
    double volume(const Element& e) const override { return pi * e.radius * e.radius * 2 * e.half.z; }
    std::optional<Vec3> second_moments(const Element& e) const override {
        const double r = e.radius, h = 2 * e.half.z, all = pi * r * r * h;
        return Vec3{all * r * r / 4, all * r * r / 4, all * h * h / 12};
    }
    MaybePart inside_along(const Element& e, const Vec3& o, const Vec3& d) const override {
        return in_cylinder(o, d, e.radius, e.half.z);
    }
    Mesh mesh(const Element& e, int segments) const override { return cylinder_mesh(e.radius, e.half.z, segments); }
    bool has_known_surface() const override { return true; }
    std::vector<ElementPoint> surface_points(const Element& e, std::size_t count) const override {
        std::vector<Patch> patches;
        add_cylinder_patches(e.half.z, e.radius, patches);
        std::vector<ElementPoint> points;
        add_points(patches, area_of(patches), count, points);
        for (int k = 0; k < 64; ++k) { // the rims
            const double angle = 2 * pi * k / 64;
            const Vec3 rim{e.radius * std::cos(angle), e.radius * std::sin(angle), e.half.z};
            points.push_back({rim, normalized(rim), 0});
            points.push_back({{rim.x, rim.y, -rim.z}, normalized({rim.x, rim.y, -rim.z}), 0});
        }
        return points;
    }
    Element grown(Element e, double length, double (*sum)(double, double)) const override {
        e.half.z = sum(e.half.z, length);
        e.radius = sum(e.radius, length);
        return e;
    }
    Element enlarged(const Element& e, std::span<const Vec3> points, double room) const override {
        return cylinder_around(e, points, room);
    }
};

constexpr std::array<std::string_view, 2> of_cylinder{"length", "radius"};
constexpr CylinderKind cylinder("cylinder", of_cylinder);

} // namespace

extern constinit const ConvexKind* const cylinder_kind = &cylinder;

} // namespace foam::inline geometry
