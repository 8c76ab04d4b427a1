// Elements upon the facets of a round primitive, whose true surface lies beneath them.
#include "tight_elements.hpp"

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::test;

namespace {

/// A thin element upon a facet: it holds the triangle, and reaches beneath it by less than the facet is above the true
/// surface.
Element plate(Kind kind, const Vec3& a, const Vec3& b, const Vec3& c, double thick) {
    const Vec3 x = normalized(b - a), z = normalized(cross(b - a, c - a)), y = cross(z, x);
    const double low = std::min({0.0, dot(c - a, x)}), high = std::max({dot(b - a, x), dot(c - a, x)});
    const double width = dot(c - a, y);
    Element e{.kind = kind};
    e.pose.rotation = {Vec3{x.x, y.x, z.x}, Vec3{x.y, y.y, z.y}, Vec3{x.z, y.z, z.z}};
    e.pose.translation = a + x * ((low + high) / 2) + y * (width / 2);
    e.half = {(high - low) / 2, width / 2, thick};
    if (kind == Kind::swept_box) {
        e.half.z = thick / 2;
        e.radius = thick / 2;
    } else if (kind == Kind::cylinder) {
        e.radius = std::hypot(e.half.x, e.half.y) + thick;
        e.half = {0, 0, thick};
    } else if (kind == Kind::box) {
        e.half += Vec3{thick, thick, 0};
    } else if (kind == Kind::hull) {
        std::vector<Vec3> points;
        const Vec3 middle = (a + b + c) / 3;
        for (const Vec3& corner : {a, b, c}) {
            const Vec3 wider = corner + (corner - middle) * 1e-9;
            points.insert(points.end(), {wider + z * thick, wider - z * thick});
        }
        e.pose = {};
        e.half = {};
        e.hull = convex_hull(points);
    }
    return e;
}

/// The point of the true surface that is deepest beneath the polyhedron around the primitive.
Vec3 beneath_a_corner(const Element& primitive) {
    const bool cylinder = primitive.kind == Element::Kind::cylinder;
    Vec3 result{};
    double deepest = 0;
    for (Vec3 p : enclosing_mesh(primitive).vertices) {
        p.z = cylinder ? 0.3 * p.z : p.z; // between the ends of an edge
        const Vec3 axis{0, 0, cylinder ? p.z : std::clamp(p.z, -primitive.half.z, primitive.half.z)};
        if (const double depth = distance(p, axis) - primitive.radius; depth > deepest) {
            deepest = depth;
            result = axis + normalized(p - axis) * primitive.radius;
        }
    }
    return result;
}

TEST(ElementShells, PlatesUponTheFacetsOfARoundPrimitiveAreNoCover) {
    // The polyhedron around the primitive is covered, and the true surface beneath its corners is not.
    Random random(6);
    for (const Kind kind : {Kind::cylinder, Kind::box, Kind::swept_box, Kind::hull}) {
        for (const auto inner : {Element::Kind::cylinder, Element::Kind::sphere, Element::Kind::capsule}) {
            const Pose pose = test::random_pose(random, 1);
            const Element primitive = test::round_element(inner, 1, 1);
            const Mesh shell = transformed(enclosing_mesh(primitive), pose);
            const auto plates = [&](double thick) {
                std::vector<Element> result;
                for (const auto& [a, b, c] : shell.triangles) {
                    const auto& v = shell.vertices;
                    result.push_back(plate(kind, v[a], v[b], v[c], thick));
                }
                return result;
            };
            const auto solid = Solid::make({{nullptr, primitive, pose}});
            const std::vector<Element> thin = plates(1e-5), thick = plates(0.05);
            EXPECT_TRUE(std::all_of(thin.begin(), thin.end(), [&](const Element& e) {
                return Judge(e).outside(test::quad(pose * beneath_a_corner(primitive))) > 0;
            }));
            EXPECT_TRUE(covers(*as_surface(*Solid::make(shell)), Elements(thin))) << to_string(kind);
            EXPECT_FALSE(covers(*as_surface(*solid), Elements(thin))) << to_string(kind) << ' ' << to_string(inner);
            EXPECT_TRUE(covers(*as_surface(*solid), Elements(thick))) << to_string(kind) << ' ' << to_string(inner);
        }
    }
}

} // namespace
