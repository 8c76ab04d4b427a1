// Elements that grow for single points and for balls beside them: by how much, in closed form.
#include "geometry/hulls.hpp"
#include "geometry/placed_elements.hpp"

#include <foam/geometry/measure.hpp>

#include <gtest/gtest.h>

#include <optional>

using namespace foam;
using namespace foam::test;
using Kind = Element::Kind;

namespace {

/// More than what growth adds so that a proof holds.
constexpr double hair = 1e-10;

/// Returns the element grown to cover the points: triangles without area.
Element grown_to_points(const Element& element, const std::vector<Vec3>& points) {
    Mesh specks;
    for (const Vec3& p : points) {
        append(specks, {{p, p, p}, {{0, 1, 2}}});
    }
    return grown_to_cover(*Solid::make(specks), Elements(std::vector{element}))[0];
}

/// Returns the element grown to cover a ball.
Element grown_to_ball(const Element& element, const Vec3& center, double radius) {
    Pose pose;
    pose.translation = center;
    return grown_to_cover(*primitive_solid(Element::sphere(radius), pose), Elements(std::vector{element}))[0];
}

TEST(GrownToPoints, ABoxReachesEachPointAlongEachAxis) {
    Random random(1);
    const Element box{.kind = Kind::box, .half = {1, 2, 3}};
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            const auto ends = [&](double end) {
                std::pair<Vec3, Vec3> result{-box.half, box.half};
                (side < 0 ? result.first : result.second)[axis] = end * side;
                return result;
            };
            Vec3 p{0.5, 0.5, 0.5};
            p[axis] = 4 * side;
            const auto [element, points] = placed(box, {p, {0.1, -0.2, 0.3}}, random);
            const auto [low, high] = ends(4);
            expect_core(element, grown_to_points(element, points), low, high, hair);
            p[axis] = side * (box.half[axis] - 0.249);
            const auto [beside, center] = placed(box, {p}, random);
            const auto [from, to] = ends(box.half[axis] + 0.001);
            expect_core(beside, grown_to_ball(beside, center[0], 0.25), from, to, hair);
        }
    }
    const auto [element, points] = placed(box, {{-4, 5, 0}, {6, 0, -7}, {0, 0, 8}}, random);
    expect_core(element, grown_to_points(element, points), {-4, -2, -7}, {6, 5, 8}, hair);
}

TEST(GrownToPoints, ACylinderReachesEachPointAcrossAndAlong) {
    Random random(2);
    const Element cylinder{.kind = Kind::cylinder, .half = {0, 0, 1}, .radius = 2};
    const auto expect = [&](const std::vector<Vec3>& own, double ball, double radius, double low, double high) {
        const auto [element, points] = placed(cylinder, own, random);
        const Element result = ball > 0 ? grown_to_ball(element, points[0], ball) : grown_to_points(element, points);
        expect_core(element, result, {0, 0, low}, {0, 0, high}, hair);
        EXPECT_NEAR(result.radius, radius, hair);
    };
    expect({{0.3, 0.4, 0.5}}, 0, 2, -1, 1);
    expect({{3, 4, 0.5}}, 0, 5, -1, 1);
    expect({{0.3, 0.4, 3}}, 0, 2, -1, 3);
    expect({{0.3, 0.4, -3}}, 0, 2, -3, 1);
    expect({{-3, 4, -3}, {1, 0, 4}}, 0, 5, -3, 4);
    expect({{0.6 * 1.751, 0.8 * 1.751, 0.5}}, 0.25, 2.001, -1, 1);
    expect({{0.3, 0.4, 0.751}}, 0.25, 2, -1, 1.001);
    expect({{0.3, 0.4, -0.751}}, 0.25, 2, -1.001, 1);
}

TEST(GrownToPoints, ACapsuleBecomesLongerOrThickerWhicheverAddsLess) {
    Random random(4);
    const Element capsule{.kind = Kind::capsule, .half = {0, 0, 4}, .radius = 5};
    const auto expect = [&](const std::vector<Vec3>& own, double radius, double low, double high) {
        const auto [element, points] = placed(capsule, own, random);
        const Element result = grown_to_points(element, points);
        expect_core(element, result, {0, 0, low}, {0, 0, high}, hair);
        EXPECT_NEAR(result.radius, radius, hair);
    };
    expect({{1, 2, 3}}, 5, -4, 4);
    expect({{3, 0, 10}}, 5, -4, 6);   // 3, 4, 5
    expect({{0, -4, -10}}, 5, -7, 4); // 4, 3, 5
    expect({{0, -4, -10}, {3, 0, 10}}, 5, -7, 6);
    expect({{6, 0, 0}}, 6, -4, 4);
    expect({{0, 8, 10}}, 10, -4, 4); // 6, 8, 10
    // a point at the side, and one that the capsule then does not have to be longer for
    expect({{6, 0, 0}, {0, 0, 9.5}}, 6, -4, 4);
    // much longer would be more than a little thicker
    expect({{4.999, 0, 4.5}}, std::hypot(4.999, 0.5), -4, 4);
}

TEST(GrownToPoints, ASweptBoxBecomesLongerWhereThePointIsFarthest) {
    Random random(6);
    const Element swept{.kind = Kind::swept_box, .half = {1, 2, 3}, .radius = 0.5};
    for (int axis = 0; axis < 3; ++axis) {
        for (const int other : {(axis + 1) % 3, (axis + 2) % 3}) {
            for (const double side : {-1.0, 1.0}) {
                Vec3 p{0.1, 0.2, 0.3}, low = -swept.half, high = swept.half;
                p[axis] = side * (swept.half[axis] + 2);
                p[other] = -side * (swept.half[other] + 0.3); // 3, 4, 5
                (side < 0 ? low : high)[axis] = side * (swept.half[axis] + 2 - 0.4);
                const auto [element, points] = placed(swept, {p}, random);
                const Element result = grown_to_points(element, points);
                EXPECT_NEAR(result.radius, 0.5, hair) << axis << other << side;
                expect_core(element, result, low, high, hair);
            }
        }
    }
    // out by the same at all three: along the first axis, and thicker where that is not enough
    const auto [element, points] = placed(swept, {{1.5, 2.5, 3.5}}, random);
    const Element thicker = grown_to_points(element, points);
    EXPECT_NEAR(thicker.radius, std::sqrt(0.75), hair);
    expect_core(element, thicker, -swept.half, swept.half, hair);
}

TEST(GrownToPoints, OfAxesThatAreOutByTheSameTheFirstBecomesLonger) {
    const Element swept{.kind = Kind::swept_box, .half = {1, 1, 1}, .radius = 0.5};
    const auto with = [&](const Vec3& p) { return grown_to_points(swept, {p}).half; };
    const double longer = 1 + 0.2; // 0.4 out, of which 0.3 are within the radius: half of the rest... on one side
    EXPECT_GT(with({1.4, 1.4, 0}).x, 1.01);
    EXPECT_EQ(with({1.4, 1.4, 0}).y, 1);
    EXPECT_GT(with({1.4, 0, 1.4}).x, 1.01);
    EXPECT_EQ(with({1.4, 0, 1.4}).z, 1);
    EXPECT_GT(with({0, 1.4, 1.4}).y, 1.01);
    EXPECT_EQ(with({0, 1.4, 1.4}).z, 1);
    EXPECT_LT(with({0, 1.4, 1.4}).y, longer);
}

TEST(GrownToPoints, AHullGetsThePointsWhereItsCornersVanishAndElseFacesMove) {
    Random random(8);
    const auto expect = [&](const std::vector<Vec3>& own, double expected) {
        const auto [element, points] = placed(cube(), own, random);
        const Element result = grown_to_points(element, points);
        EXPECT_NEAR(volume(result), expected, 1e-9);
        EXPECT_LE(result.hull->surface.vertices.size(), 8u);
        EXPECT_EQ(result.pose, element.pose);
        for (const Vec3& p : points) {
            EXPECT_TRUE(holds(result, p));
        }
    };
    expect({{0.5, 0.5, 0.5}}, 8);
    expect({{0, 0, 1.5}}, 8 + 4 * 0.5);                 // the face moves
    expect({{0, 0, 1.5}, {0, 0, -2}}, 8 + 4 * 1.5);     // both
    expect({{0.2, 0, 1.5}, {0.3, 0.1, 2}}, 8 + 4);      // by the farther one
    expect({{1.5, 1.5, 1.5}}, 8 + 3 * 4 * 0.5 / 3);     // the corner moves: three pyramids
    expect({{1.5, 1.5, 1.5}, {-3, -3, -3}}, 8 + 2 + 8); // two corners
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

/// Returns the hull grown so that each of its faces moves by a length: to a point beyond its middle. The points are
/// more than its corners, so that they do not become corners themselves. `lengths`: by which planes have to move for
/// them.
std::shared_ptr<const Polytope> with_faces_moved(const std::shared_ptr<const Polytope>& hull,
                                                 std::vector<double>& lengths) {
    std::vector<Vec3> points;
    for (std::size_t f = 0; f < hull->faces.size(); ++f) {
        const Polytope::Face& face = hull->faces[f];
        Vec3 sum{};
        int corners = 0;
        for (const Vec3& v : hull->surface.vertices) {
            if (face.offset - dot(face.normal, v) < 1e-9) {
                sum += v;
                ++corners;
            }
        }
        points.push_back(sum / corners + face.normal * lengths[f]);
    }
    for (std::size_t f = 0; f < hull->faces.size(); ++f) {
        for (const Vec3& p : points) {
            lengths[f] = std::max(lengths[f], dot(hull->faces[f].normal, p) - hull->faces[f].offset);
        }
    }
    return grown_to_points({.kind = Kind::hull, .hull = hull}, points).hull;
}

TEST(GrownToPoints, VerticesOfAHullMoveByTheLeastThatTheirPlanesAskFor) {
    Random random(1);
    int moved = 0;
    for (int k = 0; k < 150; ++k) {
        const auto hull = random_hull(4 + k % 9, random, {1, -2, 3});
        std::vector<double> lengths;
        for (std::size_t f = 0; f < hull->faces.size(); ++f) {
            lengths.push_back(k % 3 == 0 ? 0.1 : random.uniform(0, 0.01));
        }
        const auto result = with_faces_moved(hull, lengths);
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
                EXPECT_NEAR(to_nearest(v + *move, *result), 0, 1e-9) << k;
                ++moved;
            }
        }
    }
    EXPECT_GT(moved, 500);
}

TEST(GrownToPoints, FacesOfABoxMoveEachByItsLength) {
    const auto box_hull = cube().hull;
    ASSERT_EQ(box_hull->faces.size(), 6u);
    std::vector<double> lengths;
    Vec3 low, high;
    for (std::size_t f = 0; f < 6; ++f) {
        lengths.push_back(0.1 * static_cast<double>(f));
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = box_hull->faces[f].normal[axis] < -0.5 ? -1 - lengths[f] : low[axis];
            high[axis] = box_hull->faces[f].normal[axis] > 0.5 ? 1 + lengths[f] : high[axis];
        }
    }
    const auto result = with_faces_moved(box_hull, lengths);
    const Box around = bounds(result->surface);
    EXPECT_LE(norm(around.low - low) + norm(around.high - high), hair);
    EXPECT_NEAR(signed_volume(result->surface), around.size().x * around.size().y * around.size().z, 1e-12);
}

} // namespace
