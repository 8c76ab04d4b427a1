// The smallest ball about points that keeps to half-spaces.
#include "search/src/by_spheres/portfolio/problem.hpp"

#include <foam/base/random.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace foam;
using namespace foam::by_spheres;

Points circle(double radius) {
    Points points;
    for (int i = 0; i < 24; ++i) {
        const double angle = 2 * std::numbers::pi * i / 24;
        points.add({radius * std::cos(angle), radius * std::sin(angle), 0});
    }
    return points;
}

double radius_about(const Points& points, const Vec3& center) {
    return std::sqrt(farthest(points, points.size(), center).squared);
}

void expect_to_hold(const Ball& ball, const Points& points) {
    EXPECT_LE(radius_about(points, center_of(ball)), ball.r * (1 + 1e-5));
}

TEST(LimitedBall, OnADiscHasTheRadiusOfItsSegment) {
    const Points points = circle(1);
    for (const double height : {0.5, 0.1, 0.02}) {
        const Ball ball = LimitedBall({{{0, 0, -1}, height}}).of(points, points.size(), {}, {});
        EXPECT_NEAR(ball.r, (1 + height * height) / (2 * height), 2e-3 * ball.r) << height;
        EXPECT_LE(-ball.z + ball.r, height + 2e-5) << height;
        expect_to_hold(ball, points);
    }
}

TEST(LimitedBall, IsTheSmallestBallWhereThatKeepsToTheLimit) {
    const Points points = circle(1);
    const Ball free = EnclosingBall().of(points, points.size(), {}, {});
    EXPECT_EQ(LimitedBall({{{0, 0, -1}, 1.01}}).of(points, points.size(), {}, {}), free);
    EXPECT_EQ(LimitedBall().of(points, points.size(), {}, {}), free);
    EXPECT_EQ(LimitedBall({{{0, 0, -1}, 0.1}}).of(points, 0, {}, {}), Ball{});
}

struct Cloud {
    Points points;
    Limits limits;
};

/// Points at random, and limits that all of them keep to by 0.15 at least.
Cloud cloud(std::uint64_t seed, std::size_t limits) {
    Random random(seed);
    const auto direction = [&] {
        return normalized(Vec3{random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5});
    };
    Cloud result;
    for (int i = 0; i < 40; ++i) {
        result.points.add(direction() * random.uniform());
    }
    const Vec3 first = direction();
    for (std::size_t i = 0; i < limits; ++i) {
        Limit limit{i == 0 ? first : normalized(first + direction()), 0};
        for (std::size_t p = 0; p < result.points.size(); ++p) {
            limit.offset = std::max(limit.offset, dot(limit.normal, result.points.at(p)) + 0.15);
        }
        result.limits.push_back(limit);
    }
    return result;
}

TEST(LimitedBall, KeepsToLimitsAndHoldsItsPointsAndNoneNearbyIsSmaller) {
    int kept = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        const Cloud c = cloud(seed, 1 + seed % 2);
        const Ball ball = LimitedBall(c.limits).of(c.points, c.points.size(), {}, {});
        expect_to_hold(ball, c.points);
        const bool keeps = beyond(ball, c.limits) == 0;
        EXPECT_TRUE(keeps || c.limits.size() == 2) << seed; // where limits meet there need not be any
        kept += keeps;
        Random random(seed);
        for (int i = 0; i < 300; ++i) {
            const Vec3 step{random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5};
            const Vec3 center = center_of(ball) + step * (0.3 * random.uniform());
            const Ball other = ball_of({center, radius_about(c.points, center)});
            if (beyond(other, c.limits) == 0) {
                EXPECT_TRUE(keeps) << seed;
                EXPECT_GE(other.r, ball.r * 0.99) << seed;
            }
        }
    }
    EXPECT_GT(kept, 35);
}

TEST(LimitedBall, HoldsThePointsWhereNoneKeepsToTheLimits) {
    const Points points = circle(1);
    const Limits slab{{{0, 0, -1}, 0.1}, {{0, 0, 1}, 0.1}};
    const Ball ball = LimitedBall(slab).of(points, points.size(), {}, {});
    expect_to_hold(ball, points);
    EXPECT_GT(beyond(ball, slab), 0);
    const Limits through{{{0, 0, -1}, -0.1}};
    const Ball other = LimitedBall(through).of(points, points.size(), {}, {});
    expect_to_hold(other, points);
    EXPECT_GT(beyond(other, through), 0);
}

} // namespace
