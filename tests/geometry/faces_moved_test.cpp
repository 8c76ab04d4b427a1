// Polytopes whose faces move outwards: each vertex by the shortest move beyond its planes.
#include "geometry/hulls.hpp"
#include "geometry/src/convex/polytope.hpp"

#include <gtest/gtest.h>

#include <optional>

using namespace foam;
using namespace foam::test;

namespace {

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

TEST(FacesMoved, VerticesMoveByTheLeastThatTheirPlanesAskFor) {
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

TEST(FacesMoved, FacesOfABoxMoveEachByItsLength) {
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

TEST(FacesMoved, AllWithinTheLengthOfThePolytopeAndThePointsIsInside) {
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

TEST(FacesMoved, FacesMoveFartherIfAPointNeedsTheRoom) {
    const auto cube = hull_of(test::box({-1, -1, -1}, {1, 1, 1}).vertices);
    const std::vector<double> lengths(cube->faces.size(), 0.1);
    const std::vector<Vec3> point{{0, 0, 1.08}};
    const auto result = with_faces_moved(*cube, lengths, point, 0.05);
    ASSERT_TRUE(result);
    expect_room(*result, point, 0.05);
    expect_room(*result, cube->surface.vertices, 0.05);
    EXPECT_LE(bounds(result->surface).high.z, 1.1 + 8 * 0.03); // eight times as much is tried next
}

TEST(FacesMoved, FarFromTheOriginThereIsRoomForTheRounding) {
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

TEST(FacesMoved, FacesThatMeetWithinEightLengthsMove) {
    for (const double reach : {3.0, 6.0, 7.5, 8.5, 15.0}) {
        const double slope = 1 / std::sqrt(reach * reach - 1); // of the faces: their edges go out by so many lengths
        std::vector<Vec3> points = lens(40, slope);
        double length = 0.5;
        for (std::size_t k = 0; k < points.size(); k += 7) {
            std::rotate(points.begin(), points.begin() + 7, points.end());
            const auto hull = hull_of(points);
            const auto moved = with_faces_moved(*hull, std::vector<double>(hull->faces.size(), length), {}, length);
            ASSERT_TRUE(moved);
            const auto result = grown_hull(hull, length);
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

TEST(FacesMoved, TheInnerPointIsTheMeanOfTheSurface) {
    const auto wedge = hull_of({{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3}});
    // three triangles of area 4.5 and one of 4.5 √3
    const double side = 4.5 * (1 + 1 + 0) / (3 * 4.5 + 4.5 * std::sqrt(3.0)),
                 front = std::sqrt(3.0) / (3 + std::sqrt(3.0));
    const Vec3 middle = inner_point(*wedge);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(middle[axis], side + front, 1e-14);
    }
}

TEST(FacesMoved, AFewLengthsOfReachAreNoSpike) {
    // A cube, an octahedron and a ball: their faces move.
    Random random(6);
    for (const auto& hull :
         {hull_of(test::box({-1, -1, -1}, {1, 1, 1}).vertices), hull_of(lens(4, 1)), random_hull(60, random)}) {
        for (const double length : {1e-6, 1e-2, 1.0}) {
            const auto result = grown_hull(hull, length);
            const auto moved = with_faces_moved(*hull, std::vector<double>(hull->faces.size(), length), {}, length);
            ASSERT_TRUE(moved);
            EXPECT_EQ(*result, *moved);
        }
    }
}

TEST(FacesMoved, FacesMoveByManyTimesTheSize) {
    const auto cube = hull_of(test::box({-1, -1, -1}, {1, 1, 1}).vertices);
    const auto result = with_faces_moved(*cube, std::vector<double>(6, 1e4), {}, 1e4);
    ASSERT_TRUE(result);
    expect_room(*result, cube->surface.vertices, 1e4);
    EXPECT_NEAR(signed_volume(result->surface), 8 * std::pow(1e4 + 1, 3), 1e-11 * 8e12);
}

/// More planes meet at the tip than are tried together: the sum of their normals points out of all of them.
TEST(FacesMoved, TheTipOfASlenderConeMoves) {
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

} // namespace
