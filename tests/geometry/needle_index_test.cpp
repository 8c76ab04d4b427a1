// Queries on a rod of needles at an angle to the axes.
#include "geometry/src/mesh/needle_index.hpp"

#include <foam/base/random.hpp>
#include <foam/geometry/solid.hpp>

#include <gtest/gtest.h>

#include <numbers>

namespace foam {
namespace {

constexpr double length = 100, radius = 1;
const Vec3 along = normalized(Vec3{4, -8, 1});
const Vec3 across = normalized(cross(along, Vec3{0, 0, 1}));
const Vec3 third = cross(along, across);
const Vec3 middle{300, -200, 50};

Vec3 placed(double x, double y, double z) {
    return middle + along * x + across * y + third * z;
}

/// A prism of 400 sides, closed, of which each side is two needles from end to end.
Mesh rod() {
    constexpr std::uint32_t sides = 400;
    Mesh mesh;
    for (std::uint32_t i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        mesh.vertices.push_back(placed(-length / 2, radius * std::cos(angle), radius * std::sin(angle)));
        mesh.vertices.push_back(placed(length / 2, radius * std::cos(angle), radius * std::sin(angle)));
    }
    for (std::uint32_t i = 0; i < sides; ++i) {
        const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % sides);
        mesh.triangles.push_back({a, a + 1, b});
        mesh.triangles.push_back({b, a + 1, b + 1});
        if (i >= 2) {
            mesh.triangles.push_back({0, a, 2 * (i - 1)});
            mesh.triangles.push_back({1, 2 * (i - 1) + 1, a + 1});
        }
    }
    return mesh;
}

/// A direction away from the axis.
Vec3 across_at(double angle) {
    return across * std::cos(angle) + third * std::sin(angle);
}

std::vector<geometry::Corners> corners_of(const Mesh& mesh) {
    std::vector<geometry::Corners> corners;
    for (const auto& [a, b, c] : mesh.triangles) {
        corners.push_back({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
    }
    return corners;
}

bool pays(const std::vector<geometry::Corners>& triangles) {
    std::vector<Box> boxes;
    Box all;
    for (const geometry::Corners& t : triangles) {
        Box& box = boxes.emplace_back();
        for (const Vec3& corner : {t.a, t.b, t.c}) {
            box.add(corner);
            all.add(corner);
        }
    }
    return geometry::NeedleIndex::pays(boxes, all);
}

TEST(NeedleIndex, PaysForNeedlesAtAnAngleAlone) {
    EXPECT_TRUE(pays(corners_of(rod())));
    Mesh straight = rod();
    for (Vec3& v : straight.vertices) {
        v = {dot(v - middle, along), dot(v - middle, across), dot(v - middle, third)};
    }
    EXPECT_FALSE(pays(corners_of(straight)));
}

TEST(NeedleIndex, FindsWhatLookingAtEachTriangleFinds) {
    const Mesh mesh = rod();
    const std::vector<geometry::Corners> triangles = corners_of(mesh);
    const auto solid = Solid::make(mesh);
    Random random(7);
    for (int k = 0; k < 2000; ++k) {
        const double reach = k % 2 == 0 ? 1.5 : 400;
        const Vec3 local{random.uniform(-60, 60), random.uniform(-reach, reach), random.uniform(-reach, reach)};
        const Vec3 p = placed(local.x, local.y, local.z);
        double nearest = 1e300;
        for (const geometry::Corners& t : triangles) {
            nearest = std::min(nearest, distance(geometry::closest_on_triangle(t, p), p));
        }
        EXPECT_NEAR(distance(solid->closest(p).point, p), nearest, 1e-11) << k; // coordinates of 400 are rounded
        const double from_axis = std::hypot(local.y, local.z);
        if (std::abs(from_axis - radius) > 1e-3 && std::abs(std::abs(local.x) - length / 2) > 1e-3) {
            EXPECT_EQ(solid->contains(p), from_axis < radius && std::abs(local.x) < length / 2) << k;
        }
    }
}

/// How many triangles are looked at to find the nearest one.
int looked_at(const geometry::NeedleIndex& index, const std::vector<geometry::Corners>& triangles, const Vec3& p) {
    int count = 0;
    double nearest = 1e300;
    index.for_each_nearer(
        p, [&] { return nearest; },
        [&](std::uint32_t i) {
            nearest = std::min(nearest, distance(geometry::closest_on_triangle(triangles[i], p), p));
            ++count;
        });
    return count;
}

TEST(NeedleIndex, LooksAtFewNeedles) {
    std::vector<geometry::Corners> triangles = corners_of(rod());
    for (int corner = 0; corner < 6; ++corner) { // the longest edge begins at any corner, and goes either way
        const geometry::NeedleIndex index(triangles, middle);
        int near = 0, crossed = 0;
        for (int k = 0; k < 100; ++k) {
            const double angle = 0.06 * k + 0.01, y = std::cos(angle), z = std::sin(angle);
            near += looked_at(index, triangles, placed(k - 50, 1.01 * y, 1.01 * z));
            index.for_each_along(geometry::Line(placed(k / 3.0, 0, 0), along * 0.1 + across_at(angle)),
                                 [&](std::uint32_t) { ++crossed; });
        }
        EXPECT_LE(near, 100 * 7);
        EXPECT_GE(crossed, 100 * 2);
        EXPECT_LE(crossed, 100 * 10);
        for (geometry::Corners& t : triangles) {
            t = corner == 2 ? geometry::Corners{t.a, t.c, t.b} : geometry::Corners{t.b, t.c, t.a};
        }
    }
}

TEST(NeedleIndex, LooksAtFewNeedlesThatAreShortOrBesideOthersFarAway) {
    for (const double by : {1.0, 1e-4}) {
        std::vector<geometry::Corners> triangles;
        for (const geometry::Corners& t : corners_of(rod())) {
            triangles.push_back({(t.a - middle) * by, (t.b - middle) * by, (t.c - middle) * by});
        }
        const std::size_t needles = triangles.size();
        const Vec3 far = Vec3{9, 5, 7} * (1e3 * by), side{3 * by, 0, 0}, other{0, 2 * by, 0};
        triangles.push_back({far, far + side, far + other});
        const geometry::NeedleIndex index(triangles, far / 2);
        int near = 0;
        for (int k = 0; k < 100; ++k) {
            const double angle = 0.06 * k + 0.01;
            const Vec3 p = placed(k - 50, 1.01 * std::cos(angle), 1.01 * std::sin(angle));
            near += looked_at(index, triangles, (p - middle) * by);
        }
        EXPECT_LE(near, 100 * 8) << needles;
    }
}

TEST(NeedleIndex, TrianglesWithoutAreaAreFoundToo) {
    // Segments along any axis, as triangles; a frame needs a second direction.
    for (const Vec3& way : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, normalized(Vec3{1, 1, 0}),
                            normalized(Vec3{1, 1, 1})}) {
        std::vector<geometry::Corners> triangles;
        const Vec3 aside{way.y, way.z, way.x};
        for (int k = 0; k < 50; ++k) {
            const Vec3 at = aside * k;
            triangles.push_back({at, at + way * 9, at + way * 4});
        }
        const geometry::NeedleIndex index(triangles, aside * 25);
        for (int k = 0; k < 50; ++k) {
            const Vec3 p = aside * (k + 0.1) + way * 3;
            double nearest = 1e300;
            index.for_each_nearer(
                p, [&] { return nearest; },
                [&](std::uint32_t i) {
                    nearest = std::min(nearest, distance(geometry::closest_on_triangle(triangles[i], p), p));
                });
            double least = 1e300;
            for (const geometry::Corners& t : triangles) {
                least = std::min(least, distance(geometry::closest_on_triangle(t, p), p));
            }
            EXPECT_EQ(nearest, least);
            EXPECT_LE(looked_at(index, triangles, p), 13);
        }
    }
}

TEST(NeedleIndex, PaysWhereBoxesHaveMoreThanAHundredTimesTheAreaOfAll) {
    const Box all{{0, 0, 0}, {1, 2, 3}}, part{{0, 1, 1}, {1, 2, 2}}; // half areas of 11 and 3
    EXPECT_FALSE(geometry::NeedleIndex::pays(std::vector<Box>(100, all), all));
    EXPECT_TRUE(geometry::NeedleIndex::pays(std::vector<Box>(101, all), all));
    EXPECT_FALSE(geometry::NeedleIndex::pays(std::vector<Box>(366, part), all));
    EXPECT_TRUE(geometry::NeedleIndex::pays(std::vector<Box>(367, part), all));
}

} // namespace
} // namespace foam
