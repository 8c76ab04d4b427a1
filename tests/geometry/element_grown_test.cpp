// Hulls grown by a length: everything within it of the hull is inside, and not much more.
#include "geometry/hulls.hpp"

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::test;

namespace {

/// The mean of the surface.
Vec3 middle_of(const Mesh& mesh) {
    Vec3 sum{};
    double area = 0;
    for (const auto& [i, j, k] : mesh.triangles) {
        const Vec3 &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
        const double size = norm(cross(b - a, c - a));
        sum += (a + b + c) * size;
        area += 3 * size;
    }
    return sum / area;
}

TEST(ElementGrown, ManyTimesALittleRoomLeavesAllVerticesWithinThePlanes) {
    Random random(11);
    for (const int corners : {6, 30}) {
        auto hull = random_hull(corners, random);
        const std::vector<Vec3> before = hull->surface.vertices;
        for (int k = 0; k < 3000; ++k) {
            hull = grown_hull(hull, 1e-13);
        }
        expect_room(*hull, hull->surface.vertices, 0);
        expect_room(*hull, before, 3000e-13);
        EXPECT_EQ(hull->surface.vertices.size(), before.size());
    }
}

TEST(ElementGrown, ALittleRoomKeepsTheShape) {
    Random random(3);
    for (int k = 0; k < 100; ++k) {
        const auto hull = random_hull(5 + k % 40, random, k % 2 ? Vec3{} : Vec3{10, 0, -10});
        const Vec3 middle = middle_of(hull->surface);
        double depth = 9;
        for (const Polytope::Face& face : hull->faces) {
            depth = std::min(depth, face.offset - dot(face.normal, middle));
        }
        const double length = depth * std::pow(10, random.uniform(-13, -9.1));
        const auto result = grown_hull(hull, length);
        ASSERT_EQ(result->surface.triangles, hull->surface.triangles);
        expect_room(*result, hull->surface.vertices, length);
        EXPECT_EQ(hull_of(result->surface.vertices)->surface.vertices.size(), hull->surface.vertices.size());
        for (std::size_t i = 0; i < hull->surface.vertices.size(); ++i) {
            const Vec3& v = hull->surface.vertices[i];
            const double share = length / depth, rounding = 1e-14 / depth * (norm(middle) + 1);
            EXPECT_LE(distance(v + (v - middle) * share, result->surface.vertices[i]), 0.02 * share + rounding);
        }
        for (std::size_t f = 0; f < hull->faces.size(); ++f) { // planes are those of the vertices
            for (const Vec3& v : result->surface.vertices) {
                EXPECT_LE(dot(result->faces[f].normal, v), result->faces[f].offset);
            }
            EXPECT_LE(result->faces[f].offset - hull->faces[f].offset, 2 * length / depth + 1e-13 * (norm(middle) + 1));
        }
    }
}

TEST(ElementGrown, OffsetsOfSmallOnesAreRoundedByLittle) {
    Random random(7);
    for (const double size : {1e-3, 1e-6}) {
        std::vector<Vec3> points;
        for (int k = 0; k < 20; ++k) {
            points.push_back(test::random_direction(random) * size);
        }
        const auto hull = hull_of(points);
        const auto result = grown_hull(hull, 1e-14 * size);
        for (std::size_t f = 0; f < hull->faces.size(); ++f) {
            EXPECT_LE(result->faces[f].offset - hull->faces[f].offset, 1e-13 * size);
        }
    }
}

TEST(ElementGrown, AWedgeThatIsThinnerThanRoundingAtOneEndHasRoomToo) {
    for (const double thin : {1e-12, 1e-10, 1e-7}) {
        const std::vector<Vec3> wedge{{0, 0, 0},    {0, 1, 0},    {1, 0, 0},   {1, 1, 0},
                                      {0, 0, thin}, {0, 1, thin}, {1, 0, 0.1}, {1, 1, 0.1}};
        for (const double length : {1e-3, 0.1}) {
            const auto result = grown_hull(hull_of(wedge), length);
            expect_room(*result, wedge, length);
            EXPECT_LE(result->surface.vertices.size(), 8u);
            EXPECT_LE(signed_volume(result->surface), 1.4 * (1 + 2 * length) * (1 + 2 * length) * (0.1 + 2 * length));
        }
    }
}

TEST(ElementGrown, ASharpEdgeDoesNotReachOutLikeASpike) {
    Random random(4);
    for (const double length : {1e-3, 0.1, 1.0}) {
        const Pose pose = test::random_pose(random, 1);
        std::vector<Vec3> points = lens(6, 1e-3);
        for (Vec3& p : points) {
            p = pose * p;
        }
        std::rotate(points.begin(), points.begin() + 3, points.end());
        const auto result = grown_hull(hull_of(points), length);
        expect_room(*result, points, length);
        EXPECT_LE(result->surface.vertices.size(), 8u);
        // no more than the box along the longest direction, about as flat as the lens is
        EXPECT_LE(signed_volume(result->surface), 1.02 * (2 + 2 * length) * (2 + 2 * length) * (2e-3 + 2 * length));
    }
}

TEST(ElementGrown, AThinOneOfFewCornersGetsATetrahedron) {
    Random random(5);
    for (const double length : {1e-3, 0.1, 1.0}) {
        const Pose pose = test::random_pose(random, 1);
        std::vector<Vec3> points = lens(3, 1e-5);
        for (Vec3& p : points) {
            p = pose * p;
        }
        const auto result = grown_hull(hull_of(points), length);
        expect_room(*result, points, length);
        EXPECT_LE(result->surface.vertices.size(), 5u);
        const double side = std::sqrt(3.0) + 2 * length; // of the box: along an edge; and the height of the triangle
        const double box = side * (1.5 + 2 * length) * (4e-5 + 2 * length);
        EXPECT_LE(signed_volume(result->surface), 1.03 * 27 / 6 * box);
    }
}

TEST(ElementGrown, ByNothingItStaysAsItIs) {
    Element hull{.kind = Element::Kind::hull};
    hull.hull = hull_of(lens(5, 1));
    const std::vector<Element> all{{.kind = Element::Kind::sphere, .radius = 1},
                                   {.kind = Element::Kind::cylinder, .half = {0, 0, 1}, .radius = 1},
                                   {.kind = Element::Kind::box, .half = {1, 1, 1}},
                                   hull};
    for (const Element& e : all) {
        for (const double length : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
            EXPECT_EQ(grown(e, length), e);
        }
    }
}

TEST(ElementGrown, LongOnesHaveRoomForTheRoundingOfTheirLength) {
    for (int axis = 0; axis < 3; ++axis) {
        Random random(8);
        for (int k = 0; k < 40; ++k) {
            std::vector<Vec3> points;
            for (const double end : {-1e4, 1e4}) {
                Vec3 tip = test::random_direction(random);
                tip[axis] = end;
                points.push_back(tip);
            }
            for (int i = 0; i < 8; ++i) {
                points.push_back(test::random_direction(random));
            }
            const auto hull = hull_of(points);
            const auto result = grown_hull(hull, 1e-12);
            expect_room(*result, points, 1e-12);
            expect_room(*result, result->surface.vertices, 0);
        }
    }
}

TEST(ElementGrown, FarAwayASharpEdgeDoesNotReachOutLikeASpikeEither) {
    for (int k = 0; k < 16; ++k) {
        const int corners = k % 2 ? 3 : 6;
        std::vector<Vec3> points = lens(corners, corners == 3 ? 1e-5 : 1e-3);
        for (Vec3& p : points) {
            p = p + Vec3{300, -400, 500};
        }
        std::rotate(points.begin(), points.begin() + k / 2 % (corners + 2), points.end()); // any of them is the last
        const double length = 1e-3, side = corners == 3 ? std::sqrt(3.0) : 2, across = corners == 3 ? 1.5 : 2;
        const auto result = grown_hull(hull_of(points), length);
        expect_room(*result, points, length);
        const double flat = corners == 3 ? 4e-5 : 2e-3;
        const double box = (side + 2 * length) * (across + 2 * length) * (flat + 2 * length);
        EXPECT_LE(signed_volume(result->surface), corners == 3 ? 1.03 * 27 / 6 * box : 1.02 * box);
    }
}

/// Planes of hulls contain their vertices, whatever a little growth rounds.
TEST(ElementGrown, PlanesContainTheVerticesAfterALittleGrowth) {
    Random random(21);
    for (int k = 0; k < 40; ++k) {
        const auto hull = random_hull(30, random);
        const auto result = grown_hull(hull, 1e-13 * (1 + k));
        ASSERT_EQ(result->faces.size(), hull->faces.size());
        for (const Polytope::Face& face : result->faces) {
            for (const Vec3& v : result->surface.vertices) {
                const long double reached = static_cast<long double>(face.normal.x) * v.x +
                                            static_cast<long double>(face.normal.y) * v.y +
                                            static_cast<long double>(face.normal.z) * v.z;
                EXPECT_LE(reached, face.offset);
            }
        }
    }
}

TEST(ElementGrown, APlateThatIsThinnerThanItsRoundingHasRoomToo) {
    // Its middle is not surely inside.
    const Vec3 far{1e4, -1e4, 1e4}, half{1, 1, 8e-12};
    const std::vector<Vec3> corners = test::box(far - half, far + half).vertices;
    for (const double length : {1e-12, 1e-9, 1e-3, 1e2, 1e6}) {
        const auto result = grown_hull(hull_of(corners), length);
        expect_room(*result, corners, length);
        EXPECT_LE(result->surface.vertices.size(), 8u);
        EXPECT_LE(signed_volume(result->surface), 2.1 * 4 * (5e-10 + 2 * length) * (1 + 2 * length) * (1 + 2 * length));
    }
}

/// Its sides have larger triangles than its top, and are farther from the corners opposite.
TEST(ElementGrown, TheBoxLiesAlongTheDirectionInWhichThePolytopeIsThinnest) {
    Random random(22);
    constexpr double height = 0.01, length = 0.03;
    for (int k = 0; k < 20; ++k) {
        std::vector<Vec3> points;
        for (int i = 0; i < 3; ++i) {
            const double angle = 2 * std::numbers::pi * i / 3, x = std::cos(angle), y = std::sin(angle);
            points.insert(points.end(), {{x, y, 0}, {0.4 * x, 0.4 * y, height}, {0.4 * x, 0.4 * y, -height}});
        }
        std::rotate(points.begin(), points.begin() + k % 9, points.end());
        const Pose pose = test::random_pose(random, 1);
        for (Vec3& p : points) {
            p = pose * p;
        }
        const auto result = grown_hull(hull_of(points), length);
        expect_room(*result, points, length);
        EXPECT_EQ(result->surface.vertices.size(), 8u);
        const double box = (std::sqrt(3.0) + 2 * length) * (1.5 + 2 * length) * (2 * height + 2 * length);
        EXPECT_NEAR(signed_volume(result->surface), box, 0.01 * box);
    }
}

TEST(ElementGrown, FacesMoveByManyTimesTheSize) {
    const auto cube = hull_of(test::box({-1, -1, -1}, {1, 1, 1}).vertices);
    const auto result = grown_hull(cube, 1e4);
    expect_room(*result, cube->surface.vertices, 1e4);
    EXPECT_NEAR(signed_volume(result->surface), 8 * std::pow(1e4 + 1, 3), 1e-11 * 8e12);
}

/// More planes meet at the tip than are tried together: the sum of their normals points out of all of them.
TEST(ElementGrown, TheTipOfASlenderConeMoves) {
    constexpr int sides = 48;
    constexpr double height = 8;
    std::vector<Vec3> points{{0, 0, height}};
    for (int k = 0; k < sides; ++k) {
        const double angle = 2 * std::numbers::pi * k / sides;
        points.push_back({std::cos(angle), std::sin(angle), 0});
    }
    const double length = 0.01, across = std::cos(std::numbers::pi / sides);
    const auto result = grown_hull(hull_of(points), length);
    expect_room(*result, points, length);
    const double tip = height + length * std::hypot(height, across) / across; // the planes of the sides meet there
    EXPECT_NEAR(support(Element{.kind = Element::Kind::hull, .hull = result}, {0, 0, 1}).z, tip, 1e-6);
}

TEST(ElementGrown, ScalesWithAll) {
    // By powers of two, which round nothing: a step that knows a length would do otherwise.
    Random random(9);
    for (int k = 0; k < 30; ++k) {
        std::vector<Vec3> points = k < 20 ? lens(3 + k % 5, std::pow(10, -k % 4)) : lens(20, 1);
        const Pose pose = test::random_pose(random, 2);
        for (Vec3& p : points) {
            p = pose * p;
        }
        for (const double length : {1e-12, 1e-3, 1.0}) {
            const auto once = grown_hull(hull_of(points), length);
            for (const double by : {0x1p-12, 0x1p12}) {
                std::vector<Vec3> others = points;
                for (Vec3& p : others) {
                    p = p * by;
                }
                const auto result = grown_hull(hull_of(others), length * by);
                const double volume = signed_volume(once->surface) * by * by * by, digits = 1e-10;
                EXPECT_EQ(result->surface.vertices.size(), once->surface.vertices.size());
                EXPECT_NEAR(signed_volume(result->surface), volume, digits * volume);
                const Box box = bounds(result->surface),
                          wanted{bounds(once->surface).low * by, bounds(once->surface).high * by};
                EXPECT_LE(norm(box.low - wanted.low) + norm(box.high - wanted.high), digits * wanted.diagonal());
            }
        }
    }
}

} // namespace
