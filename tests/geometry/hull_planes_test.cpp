// Planes of an eroded hull: they go through the lowest corners of their triangles.
#include "geometry/some_elements.hpp"
#include "geometry/src/proof/bodies.hpp"

#include <foam/geometry/internal/triangles.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace foam;
using namespace foam::geometry;
using namespace foam::test;
using Kind = Element::Kind;

namespace {

/// Expects that each triangle of the hull of points lies on or above a plane of the body before its erosion. No plane is
/// farther inside than by `lower`, what rounding asks for.
void expect_planes_below_triangles(const std::vector<Vec3>& points, std::size_t faces, double lower) {
    Element e{.kind = Kind::hull, .hull = convex_hull(points)};
    const auto hull = convex_hull(e.hull->surface.vertices);
    const Bodies bodies(Elements(std::span(&e, 1)), {}, 1, most_halvings);
    const double rounding = 0x1p-51;
    const Vec3 middle = bodies.center(0);
    ASSERT_EQ(bodies.planes(0).size(), hull->faces.size());
    ASSERT_GE(hull->faces.size(), faces);
    for (const auto& t : hull->surface.triangles) {
        double highest = -1; // above a plane, of the corner that is lowest there
        for (const Polytope::Face& plane : bodies.planes(0)) {
            double lowest = 1;
            for (const std::uint32_t v : t) {
                const double height = dot(plane.normal, hull->surface.vertices[v] - middle);
                lowest = std::min(lowest, height - (plane.offset + bodies.slack(0)));
            }
            highest = std::max(highest, lowest);
        }
        EXPECT_GE(highest, -rounding);
    }
    for (std::size_t f = 0; f < hull->faces.size(); ++f) {
        const double given = hull->faces[f].offset - dot(hull->faces[f].normal, middle);
        EXPECT_LE(bodies.planes(0)[f].offset + bodies.slack(0), given + rounding);
        EXPECT_GE(bodies.planes(0)[f].offset + bodies.slack(0), given - lower);
    }
}

TEST(Bodies, PlanesOfAHullGoThroughTheLowestCornersOfTheirTriangles) {
    Random random(5);
    for (int round = 0; round < 20; ++round) {
        // The ends of the prism are plane only up to rounding. Points just beyond the edges of the box make triangles
        // that are too thin for a plane of their own.
        std::vector<Vec3> prism, box = test::box({-1, -0.7, -0.6}, {1, 0.7, 0.6}).vertices;
        for (int k = 0; k < 12; ++k) {
            const double angle = k * std::numbers::pi / 6 + 0.1;
            for (const double z : {-0.5, 0.5}) {
                prism.push_back({std::cos(angle), std::sin(angle), z + random.uniform(-1e-15, 1e-15)});
            }
        }
        expect_planes_below_triangles(prism, 14, 5e-14);
        for (int k = 0; k < 10; ++k) {
            Vec3 p{random.uniform(-1, 1), random.uniform(-0.7, 0.7), random.uniform(-0.6, 0.6)};
            const int along = k % 3;
            for (int axis = 0; axis < 3; ++axis) {
                const double end = axis == 0 ? 1 : axis == 1 ? 0.7 : 0.6;
                p[axis] = axis == along ? p[axis] : std::copysign(end + random.uniform(0, 1e-14), p[axis]);
            }
            box.push_back(p);
        }
        expect_planes_below_triangles(box, 6, 5e-14);
        for (Vec3& p : box) { // far from the origin of its frame, where planes are higher above their triangles
            p += Vec3{100, 30, 20};
        }
        expect_planes_below_triangles(box, 6, 1e-12);
        std::vector<Vec3> corners; // of a box, several within 1e-14 each
        for (int k = 0; k < 60; ++k) {
            const Vec3 corner{k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0};
            corners.push_back(corner + test::random_direction(random) * 1e-14);
        }
        expect_planes_below_triangles(corners, 6, 1e-12);
    }
}

} // namespace
