// Polytopes whose faces move outwards: what they then contain.
#include "geometry/hulls.hpp"
#include "geometry/src/convex/polytope.hpp"

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::test;

namespace {

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

} // namespace
