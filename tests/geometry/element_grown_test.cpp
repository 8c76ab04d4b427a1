// Polytopes whose faces move outwards: each vertex by the shortest move beyond its planes.
#include "geometry/src/convex/polytope.hpp"
#include "plain_shapes.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <optional>

using namespace foam;

namespace {

std::shared_ptr<const Polytope> hull_of(const std::vector<Vec3>& points) {
    return convex_hull(points);
}

std::shared_ptr<const Polytope> random_hull(int corners, Random& random, const Vec3& middle = {}) {
    std::vector<Vec3> points;
    for (int k = 0; k < corners; ++k) {
        points.push_back(middle + test::random_direction(random));
    }
    return convex_hull(points);
}

/// The shortest vector m with normals[i] · m >= least[i], by Hildreth's method; nothing where that converges slowly.
std::optional<Vec3> shortest(const std::vector<Vec3>& normals, const std::vector<double>& least) {
    Vec3 m{};
    std::vector<double> weights(normals.size(), 0.0);
    for (int round = 0; round < 2'000; ++round) {
        double changed = 0;
        for (std::size_t i = 0; i < normals.size(); ++i) {
            const double weight = std::max(0.0, weights[i] + least[i] - dot(normals[i], m));
            m += normals[i] * (weight - weights[i]);
            changed = std::max(changed, std::abs(weight - weights[i]));
            weights[i] = weight;
        }
        if (changed < 1e-15) {
            return m;
        }
    }
    return std::nullopt;
}

double to_nearest(const Vec3& p, const Polytope& hull) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec3& v : hull.surface.vertices) {
        nearest = std::min(nearest, distance(v, p));
    }
    return nearest;
}

/// Expects that all planes of the outer polytope are at least `length` away from the points.
void expect_room(const Polytope& outer, std::span<const Vec3> points, double length) {
    for (const Polytope::Face& face : outer.faces) {
        for (const Vec3& p : points) {
            EXPECT_GE(face.offset - dot(face.normal, p), length);
        }
    }
}

/// Two pyramids upon a regular polygon: flat ones have a sharp edge all around.
std::vector<Vec3> lens(int corners, double height) {
    std::vector<Vec3> points{{0, 0, height}, {0, 0, -height}};
    for (int k = 0; k < corners; ++k) {
        const double angle = 2 * std::numbers::pi * k / corners;
        points.push_back({std::cos(angle), std::sin(angle), 0});
    }
    return points;
}

TEST(ElementGrown, VerticesMoveByTheLeastThatTheirPlanesAskFor) {
    Random random(1);
    int moved = 0;
    for (int k = 0; k < 150; ++k) {
        const auto hull = random_hull(4 + k % 9, random, {1, -2, 3});
        std::vector<double> lengths;
        for (std::size_t f = 0; f < hull->faces.size(); ++f) {
            lengths.push_back(k % 3 == 0 ? 0.1 : random.uniform(0, 0.01));
        }
        const auto result = with_faces_moved(*hull, lengths, {}, 0);
        ASSERT_TRUE(result);
        EXPECT_LE(result->surface.vertices.size(), hull->surface.vertices.size());
        for (const Vec3& v : hull->surface.vertices) {
            std::vector<Vec3> normals;
            std::vector<double> least;
            for (std::size_t f = 0; f < hull->faces.size(); ++f) {
                if (std::abs(hull->faces[f].offset - dot(hull->faces[f].normal, v)) < 1e-9) {
                    normals.push_back(hull->faces[f].normal);
                    least.push_back(lengths[f]);
                }
            }
            const std::optional<Vec3> move = shortest(normals, least);
            if (move && result->surface.vertices.size() == hull->surface.vertices.size()) {
                EXPECT_NEAR(to_nearest(v + *move, *result), 0, 1e-10) << k;
                ++moved;
            }
        }
    }
    EXPECT_GT(moved, 500);
}

TEST(ElementGrown, FacesOfABoxMoveEachByItsLength) {
    const auto cube = hull_of(test::box({-1, -1, -1}, {1, 1, 1}).vertices);
    ASSERT_EQ(cube->faces.size(), 6u);
    std::vector<double> lengths;
    Vec3 low, high;
    for (std::size_t f = 0; f < 6; ++f) {
        lengths.push_back(0.1 * static_cast<double>(f));
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = cube->faces[f].normal[axis] < -0.5 ? -1 - lengths[f] : low[axis];
            high[axis] = cube->faces[f].normal[axis] > 0.5 ? 1 + lengths[f] : high[axis];
        }
    }
    const auto result = with_faces_moved(*cube, lengths, {}, 0);
    ASSERT_TRUE(result);
    const Box box = bounds(result->surface);
    EXPECT_LE(norm(box.low - low) + norm(box.high - high), 1e-13);
    EXPECT_NEAR(signed_volume(result->surface), box.size().x * box.size().y * box.size().z, 1e-12);
}

TEST(ElementGrown, AllWithinTheLengthOfThePolytopeAndThePointsIsInside) {
    Random random(2);
    for (int k = 0; k < 100; ++k) {
        const auto hull = random_hull(4 + k % 40, random);
        const double length = std::pow(10, random.uniform(-15, -1));
        const std::vector<double> lengths(hull->faces.size(), length);
        const std::vector<Vec3> corner{hull->surface.vertices[0]};
        const auto result = with_faces_moved(*hull, lengths, corner, length);
        ASSERT_TRUE(result);
        expect_room(*result, hull->surface.vertices, length);
        const auto more = with_faces_moved(*hull, std::vector<double>(hull->faces.size(), length + 1e-11), {}, 0);
        EXPECT_LE(signed_volume(result->surface), signed_volume(more->surface) * (1 + 1e-13));
        // points that the moved planes do not hold
        const std::vector<Vec3> far{hull->surface.vertices[0] * 9};
        EXPECT_FALSE(with_faces_moved(*hull, lengths, far, length));
    }
}

TEST(ElementGrown, FacesMoveFartherIfAPointNeedsTheRoom) {
    const auto cube = hull_of(test::box({-1, -1, -1}, {1, 1, 1}).vertices);
    const std::vector<double> lengths(cube->faces.size(), 0.1);
    const std::vector<Vec3> point{{0, 0, 1.08}};
    const auto result = with_faces_moved(*cube, lengths, point, 0.05);
    ASSERT_TRUE(result);
    expect_room(*result, point, 0.05);
    expect_room(*result, cube->surface.vertices, 0.05);
    EXPECT_LE(bounds(result->surface).high.z, 1.1 + 8 * 0.03); // eight times as much is tried next
}

TEST(ElementGrown, FarFromTheOriginThereIsRoomForTheRounding) {
    Random random(10);
    for (int k = 0; k < 100; ++k) {
        const auto hull = random_hull(4 + k % 40, random, Vec3{100, -200, 300});
        const double length = std::pow(10, random.uniform(-12, -1));
        const std::vector<double> lengths(hull->faces.size(), length);
        const auto result = with_faces_moved(*hull, lengths, {}, length);
        ASSERT_TRUE(result);
        expect_room(*result, hull->surface.vertices, length);
        const auto more = with_faces_moved(*hull, std::vector<double>(hull->faces.size(), length + 1e-9), {}, 0);
        EXPECT_LE(signed_volume(result->surface), signed_volume(more->surface) * (1 + 1e-11));
    }
}

TEST(ElementGrown, ManyTimesALittleRoomLeavesAllVerticesWithinThePlanes) {
    Random random(11);
    for (const int corners : {6, 30}) {
        auto hull = random_hull(corners, random);
        const std::vector<Vec3> before = hull->surface.vertices;
        for (int k = 0; k < 3000; ++k) {
            hull = with_room(*hull, 1e-13);
        }
        expect_room(*hull, hull->surface.vertices, 0);
        expect_room(*hull, before, 3000e-13);
        EXPECT_EQ(hull->surface.vertices.size(), before.size());
    }
}

TEST(ElementGrown, FacesThatMeetWithinEightLengthsMove) {
    for (const double reach : {3.0, 6.0, 7.5, 8.5, 15.0}) {
        const double slope = 1 / std::sqrt(reach * reach - 1); // of the faces: their edges go out by so many lengths
        std::vector<Vec3> points = lens(40, slope);
        double length = 0.5;
        for (std::size_t k = 0; k < points.size(); k += 7) {
            std::rotate(points.begin(), points.begin() + 7, points.end());
            const auto hull = hull_of(points);
            const auto moved = with_faces_moved(*hull, std::vector<double>(hull->faces.size(), length), {}, length);
            ASSERT_TRUE(moved);
            const auto result = with_room(*hull, length);
            expect_room(*result, points, length);
            const double smaller = signed_volume(moved->surface) - signed_volume(result->surface);
            EXPECT_EQ(smaller > 0, reach > 8) << reach; // else a box would be smaller, and would not be taken
            for (Vec3& p : points) {                    // the same in small
                p = p / 4;
            }
            length /= 4;
        }
    }
}

TEST(ElementGrown, ALittleRoomKeepsTheShape) {
    Random random(3);
    for (int k = 0; k < 100; ++k) {
        const auto hull = random_hull(5 + k % 40, random, k % 2 ? Vec3{} : Vec3{10, 0, -10});
        const Vec3 middle = inner_point(*hull);
        double depth = 9;
        for (const Polytope::Face& face : hull->faces) {
            depth = std::min(depth, face.offset - dot(face.normal, middle));
        }
        const double length = depth * std::pow(10, random.uniform(-13, -9.1));
        const auto result = with_room(*hull, length);
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

TEST(ElementGrown, TheInnerPointIsTheMeanOfTheSurface) {
    const auto wedge = hull_of({{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}});
    // three triangles of area 4.5 and one of 4.5 √3
    const double side = 4.5 * (1 + 1 + 0) / (3 * 4.5 + 4.5 * std::sqrt(3.0)),
                 front = std::sqrt(3.0) / (3 + std::sqrt(3.0));
    const Vec3 middle = inner_point(*wedge);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(middle[axis], side + front, 1e-14);
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
        const auto result = with_room(*hull, 1e-14 * size);
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
            const auto result = with_room(*hull_of(wedge), length);
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
        const auto result = with_room(*hull_of(points), length);
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
        const auto result = with_room(*hull_of(points), length);
        expect_room(*result, points, length);
        EXPECT_LE(result->surface.vertices.size(), 5u);
        const double side = std::sqrt(3.0) + 2 * length; // of the box: along an edge; and the height of the triangle
        const double box = side * (1.5 + 2 * length) * (4e-5 + 2 * length);
        EXPECT_LE(signed_volume(result->surface), 1.03 * 27 / 6 * box);
    }
}

TEST(ElementGrown, AFewLengthsOfReachAreNoSpike) {
    // A cube, an octahedron and a ball: their faces move.
    Random random(6);
    for (const auto& hull :
         {hull_of(test::box({-1, -1, -1}, {1, 1, 1}).vertices), hull_of(lens(4, 1)), random_hull(60, random)}) {
        for (const double length : {1e-6, 1e-2, 1.0}) {
            const auto result = with_room(*hull, length);
            const auto moved = with_faces_moved(*hull, std::vector<double>(hull->faces.size(), length), {}, length);
            ASSERT_TRUE(moved);
            EXPECT_EQ(*result, *moved);
        }
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
            const auto result = with_room(*hull, 1e-12);
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
        const auto result = with_room(*hull_of(points), length);
        expect_room(*result, points, length);
        const double flat = corners == 3 ? 4e-5 : 2e-3;
        const double box = (side + 2 * length) * (across + 2 * length) * (flat + 2 * length);
        EXPECT_LE(signed_volume(result->surface), corners == 3 ? 1.03 * 27 / 6 * box : 1.02 * box);
    }
}

TEST(ElementGrown, FacesMoveByManyTimesTheSize) {
    const auto cube = hull_of(test::box({-1, -1, -1}, {1, 1, 1}).vertices);
    const auto result = with_faces_moved(*cube, std::vector<double>(6, 1e4), {}, 1e4);
    ASSERT_TRUE(result);
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
    const auto cone = hull_of(points);
    const double length = 0.01, across = std::cos(std::numbers::pi / sides);
    const auto result = with_faces_moved(*cone, std::vector<double>(cone->faces.size(), length), {}, length);
    ASSERT_TRUE(result);
    expect_room(*result, points, length);
    const double tip = height + length * std::hypot(height, across) / across; // the planes of the sides meet there
    EXPECT_NEAR(support(Element{.kind = Element::Kind::hull, .hull = result}, {0, 0, 1}).z, tip, 1e-6);
}

/// Planes of hulls contain their vertices, whatever a little growth rounds.
TEST(ElementGrown, PlanesContainTheVerticesAfterALittleGrowth) {
    Random random(21);
    for (int k = 0; k < 40; ++k) {
        const auto hull = random_hull(30, random);
        const auto result = with_room(*hull, 1e-13 * (1 + k));
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
        const auto result = with_room(*hull_of(corners), length);
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
        const auto result = with_room(*hull_of(points), length);
        expect_room(*result, points, length);
        EXPECT_EQ(result->surface.vertices.size(), 8u);
        const double box = (std::sqrt(3.0) + 2 * length) * (1.5 + 2 * length) * (2 * height + 2 * length);
        EXPECT_NEAR(signed_volume(result->surface), box, 0.01 * box);
    }
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
            const auto once = with_room(*hull_of(points), length);
            for (const double by : {0x1p-12, 0x1p12}) {
                std::vector<Vec3> others = points;
                for (Vec3& p : others) {
                    p = p * by;
                }
                const auto result = with_room(*hull_of(others), length * by);
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
