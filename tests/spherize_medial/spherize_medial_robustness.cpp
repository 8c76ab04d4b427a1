// Solids that break things: flat, thin, tiny, far away, open, in pieces, without volume.
#include "fixture.hpp"

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::test;

namespace {

Mesh scaled(Mesh mesh, double factor, const Vec3& offset = {}) {
    for (Vec3& v : mesh.vertices) {
        v = v * factor + offset;
    }
    return mesh;
}

void expect_sound(const Mesh& mesh, std::size_t count) {
    const Shape shape = shape_of(mesh);
    QuietContext context;
    const SphereTree tree = medial()->spherize(shape, at_most(count), context);
    ASSERT_GE(tree.finest().size(), 1u);
    ASSERT_LE(tree.finest().size(), count);
    for (const auto& level : tree.levels) {
        for (const Sphere& sphere : level.elements.spheres()) {
            ASSERT_TRUE(is_finite(sphere.center));
            ASSERT_TRUE(std::isfinite(sphere.radius));
            ASSERT_GT(sphere.radius, 0);
        }
    }
    EXPECT_LE(largest_gap(shape.original(), tree.finest()), 0.01 * shape.original().bounds().diagonal());
}

} // namespace

TEST(SpherizeMedialRobustness, ThinPlate) {
    for (const std::size_t count : {1, 2, 6, 20}) {
        expect_sound(box({0.3, 0.2, 0.0005}), count);
    }
    // The balls of a plate are those of the rectangle: six squares of 0.1 m, each in a ball of 0.0707 m.
    const Mesh plate = box({0.3, 0.2, 0.0005});
    const double radius = std::sqrt(0.005);
    EXPECT_LT(union_volume(spheres(plate, 6)), 1.1 * 6 * 4.0 / 3.0 * std::numbers::pi * radius * radius * radius);
}

TEST(SpherizeMedialRobustness, TinyHugeAndFarAway) {
    const Mesh mesh = bracket(0.2, 0.05);
    const double here = excess(mesh, spheres(mesh, 5));
    for (const double factor : {1e-7, 1e6}) {
        const Mesh other = scaled(mesh, factor);
        expect_sound(other, 5);
        EXPECT_NEAR(excess(other, spheres(other, 5)), here, 0.05 * here) << factor;
    }
    const Mesh far = scaled(mesh, 1, {1000, -2000, 500});
    expect_sound(far, 5);
    EXPECT_NEAR(excess(far, spheres(far, 5)), here, 0.05 * here);
}

TEST(SpherizeMedialRobustness, PoseMattersLittle) {
    const Mesh mesh = box({0.3, 0.08, 0.05});
    const double straight = excess(mesh, spheres(mesh, 4));
    const Mesh askew = transformed(mesh, Pose::from_xyz_rpy({0.1, 0.2, 0.3}, {0.5, 0.7, 1.1}));
    EXPECT_NEAR(excess(askew, spheres(askew, 4)), straight, 0.05 * straight);
}

TEST(SpherizeMedialRobustness, SeveralParts) {
    Mesh mesh = box({0.1, 0.1, 0.1});
    append(mesh, box({0.1, 0.1, 0.1}, {0.5, 0, 0}));
    append(mesh, ball(0.05));
    expect_sound(mesh, 1);
    expect_sound(mesh, 2);
    expect_sound(mesh, 7);
    const auto two = spheres(mesh, 2);
    EXPECT_LT(std::max(two[0].radius, two[1].radius), 0.09); // one for each box
}

TEST(SpherizeMedialRobustness, OpenAndFlatSurfaces) {
    Mesh open = box({0.2, 0.1, 0.1});
    open.triangles.resize(10);
    expect_sound(open, 4);
    Mesh sheet;
    sheet.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
    expect_sound(sheet, 4);
    Mesh triangle = sheet;
    triangle.triangles.resize(1);
    expect_sound(triangle, 3);
}

TEST(SpherizeMedialRobustness, SurfaceWithoutInsideIsSaidSo) {
    Mesh needle;
    needle.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    needle.triangles = {{0, 1, 2}};
    ListeningContext context;
    const auto tree = medial()->spherize(shape_of(needle, "needle"), at_most(3), context);
    EXPECT_EQ(tree.finest().size(), 3u);
    ASSERT_FALSE(context.messages.empty());
    EXPECT_NE(context.messages[0].find("no medial sphere lies inside needle"), std::string::npos)
        << context.messages[0];
}

TEST(SpherizeMedialRobustness, NeedleAndPoint) {
    Mesh needle;
    needle.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    needle.triangles = {{0, 1, 2}};
    expect_sound(needle, 1);
    expect_sound(needle, 3);
    Mesh dot;
    dot.vertices = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
    dot.triangles = {{0, 1, 2}};
    expect_sound(dot, 1);
    expect_sound(dot, 4);
}

TEST(SpherizeMedialRobustness, Primitives) {
    for (const Element& primitive :
         {Element::box({0.1, 0.2, 0.3}), Element::sphere(0.1),
          Element::cylinder(0.05, 0.4), Element::capsule(0.05, 0.4)}) {
        Solid::Part part;
        part.primitive = primitive;
        part.pose = Pose::from_xyz_rpy({0, 0, 1}, {0.3, 0, 0});
        const auto solid = Solid::make(std::vector{part});
        QuietContext context;
        const auto tree = medial()->spherize(Shape("primitive", solid, solid), at_most(4), context);
        EXPECT_EQ(tree.finest().size(), primitive.kind == Element::Kind::sphere ? 1u : 4u);
        EXPECT_LT(largest_gap(*solid, tree.finest()), 0.01 * solid->bounds().diagonal());
    }
}

TEST(SpherizeMedialRobustness, MoreSpheresThanCornersOfSmallParts) {
    expect_sound(box({0.1, 0.1, 0.1}), 300);
}
