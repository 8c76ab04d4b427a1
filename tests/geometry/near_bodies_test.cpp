// Eroded elements beside a point or a piece: which ones are found, and how far outside it is.
#include "evaluate/element_truth.hpp"
#include "geometry/some_elements.hpp"
#include "geometry/src/proof/bodies.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace foam;
using namespace foam::geometry;
using namespace foam::test;
using Kind = Element::Kind;

namespace {

std::vector<Element> many(Random& random, double range) {
    std::vector<Element> elements;
    for (int k = 0; k < 60; ++k) {
        elements.push_back(some_element(static_cast<Kind>(k % 6), random));
        elements.back().pose.translation = Vec3{random.uniform(-range, range), random.uniform(-range, range), 0};
    }
    return elements;
}

TEST(Bodies, AreFoundByPlace) {
    Random random(2);
    const std::vector<Element> elements = many(random, 6);
    const Bodies bodies({{}, elements}, {}, 10, most_halvings);
    std::vector<std::uint32_t> result{7, 7};
    for (int k = 0; k < 300; ++k) {
        const Vec3 p = test::random_point(random, {{-8, -8, -2}, {8, 8, 2}});
        Box box{p, p};
        if (k % 2) {
            box.add(p + test::random_direction(random));
        }
        std::vector<std::uint32_t> meet, hold, holders;
        for (std::uint32_t i = 0; i < bodies.size(); ++i) {
            const Box& b = bodies.bounds(i);
            bool meets = true;
            for (int axis = 0; axis < 3; ++axis) {
                meets = meets && b.low[axis] <= box.high[axis] && b.high[axis] >= box.low[axis];
            }
            if (meets) {
                meet.push_back(i);
            }
            if (bodies.holds(i, p)) {
                hold.push_back(i);
            }
        }
        bodies.meeting(box, result);
        EXPECT_EQ(result, meet);
        bodies.holders(p, [&](std::uint32_t i) { holders.push_back(i); });
        std::sort(holders.begin(), holders.end());
        EXPECT_EQ(holders, hold);
    }
}

TEST(Bodies, NearAreThoseThatMayBeNearestToAPoint) {
    Random random(3);
    const std::vector<Element> elements = many(random, 20);
    const Bodies bodies({{}, elements}, {}, 10, most_halvings);
    for (int k = 0; k < 100; ++k) {
        const Vec3 a = test::random_point(random, {{-20, -20, -5}, {20, 20, 5}});
        const Piece piece{.corners = {a, a + test::random_direction(random) * 2, a + test::random_direction(random)},
                          .beneath = {}};
        std::vector<std::uint32_t> near{3, 8, 1, 9, 27, 30, 31, 41, 55}, expected = near;
        const PieceMiddle middle = middle_of(piece);
        double least = 1e300;
        for (std::size_t i = 2; i < 8; ++i) {
            least = std::min(least, bodies.growth(near[i], middle.point));
        }
        for (std::size_t i = 2; i < 8; ++i) {
            if (bodies.growth(near[i], middle.point) <= least + 2.0005 * middle.radius) {
                expected.push_back(near[i]);
            }
        }
        bodies.choose_near(piece, 2, 8, near);
        EXPECT_EQ(near, expected) << k;
    }
}

TEST(Bodies, NearAreThoseThatMayContainAPointInSpiteOfTheirSlack) {
    // A body that needs the least and one that needs more: by twice the piece's radius, and by some slacks.
    const Piece piece{.corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .beneath = {}};
    const PieceMiddle middle = middle_of(piece);
    for (const double slacks : {3.5, 3.9, 4.1, 4.5}) {
        std::vector<Element> balls(2, {.kind = Kind::sphere, .radius = 1});
        balls[0].pose.translation = middle.point + Vec3{0, 0, 2};
        double more = 0;
        for (int k = 0; k < 3; ++k) { // the slack depends a little on the place
            balls[1].pose.translation = middle.point - Vec3{0, 0, 2 + more};
            const Bodies bodies({{}, balls}, {}, 5, most_halvings, caution);
            ASSERT_GT(bodies.slack(1), 1e-5);
            more = 2.001 * middle.radius + slacks * bodies.slack(1) - (bodies.slack(1) - bodies.slack(0));
        }
        const Bodies bodies({{}, balls}, {}, 5, most_halvings, caution);
        std::vector<std::uint32_t> near{0, 1};
        bodies.choose_near(piece, 0, 2, near);
        EXPECT_EQ(near.size(), slacks < 4 ? 4u : 3u) << slacks;
    }
}

TEST(Bodies, TheGapIsThatOfTheCornerThatIsFarthestFromAllBodies) {
    std::vector<Element> balls(2, {.kind = Kind::sphere, .radius = 1});
    balls[0].pose.translation = {-2, 0, 0};
    balls[1].pose.translation = {4, 0, 0};
    const Bodies bodies({{}, balls}, {}, 5, most_halvings);
    const std::array<std::uint32_t, 2> both{0, 1};
    // Corners are 1, 0.5 and 3 from the first, and 3, 3.5 and 1 from the second.
    const Piece piece{.corners = {{0, 0, 0}, {-0.5, 0, 0}, {2, 0, 0}}, .beneath = {}};
    const Bodies::Gap gap = bodies.gap(piece, both);
    EXPECT_FALSE(gap.held);
    EXPECT_NEAR(gap.lower, 1, 1e-12);
    EXPECT_NEAR(gap.upper, 3, 1e-12);
    EXPECT_NE(gap.farthest, 1u);
    EXPECT_NEAR(bodies.gap(piece, std::span(both).first(1)).lower, 3, 1e-12);
    EXPECT_EQ(bodies.gap(piece, std::span(both).first(1)).farthest, 2u);
    EXPECT_NEAR(bodies.gap(piece, std::span(both).last(1)).upper, 3.5, 1e-12);
    EXPECT_EQ(bodies.gap(piece, std::span(both).last(1)).farthest, 1u);
    const Piece inside{.corners = {{4, 0, 0}, {4.5, 0, 0}, {4, 0.5, 0}}, .beneath = {}};
    EXPECT_TRUE(bodies.gap(inside, both).held);
    EXPECT_FALSE(bodies.gap(inside, std::span(both).first(1)).held);
    // Between the two, nearer to either: 0.25 from the first at most.
    const Piece near{.corners = {{-0.75, 0, 0}, {-0.9, 0, 0}, {-1.5, 0, 0}}, .beneath = {}};
    EXPECT_NEAR(bodies.gap(near, both).upper, 0.25, 1e-12);
    EXPECT_NEAR(bodies.gap(near, both).lower, 0.25, 1e-12);
    EXPECT_EQ(bodies.gap(near, both).farthest, 0u);
    const Piece prism{.corners = inside.corners, .beneath = {{4, 0, 0}, {4.5, 0, 2}, {4, 0.5, 0}}, .curved = true};
    EXPECT_FALSE(bodies.gap(prism, both).held);
    EXPECT_EQ(bodies.gap(prism, std::span(both).last(1)).farthest, 4u);
    EXPECT_TRUE(bodies.holds(1, inside));
    EXPECT_FALSE(bodies.holds(0, inside));
    EXPECT_FALSE(bodies.holds(1, prism));
}

} // namespace
