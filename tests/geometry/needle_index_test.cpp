// The index of needles: when it pays, and how few triangles it looks at.
#include "geometry/rod_of_needles.hpp"
#include "geometry/src/mesh/needle_index.hpp"

#include <gtest/gtest.h>

namespace foam {
namespace {

using namespace test::needles;

/// A direction away from the axis.
Vec3 across_at(double angle) {
    return across * std::cos(angle) + third * std::sin(angle);
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
        v = {dot(v - rod_middle, along), dot(v - rod_middle, across), dot(v - rod_middle, third)};
    }
    EXPECT_FALSE(pays(corners_of(straight)));
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
        const geometry::NeedleIndex index(triangles, rod_middle);
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
            triangles.push_back({(t.a - rod_middle) * by, (t.b - rod_middle) * by, (t.c - rod_middle) * by});
        }
        const std::size_t needles = triangles.size();
        const Vec3 far = Vec3{9, 5, 7} * (1e3 * by), side{3 * by, 0, 0}, other{0, 2 * by, 0};
        triangles.push_back({far, far + side, far + other});
        const geometry::NeedleIndex index(triangles, far / 2);
        int near = 0;
        for (int k = 0; k < 100; ++k) {
            const double angle = 0.06 * k + 0.01;
            const Vec3 p = placed(k - 50, 1.01 * std::cos(angle), 1.01 * std::sin(angle));
            near += looked_at(index, triangles, (p - rod_middle) * by);
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
