// Balls that may have the least power at points close together.
#include "search/src/by_spheres/portfolio/problem.hpp"

#include <foam/base/random.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace {

using namespace foam;
using namespace foam::by_spheres;

float between(Random& random, double low, double high) {
    return static_cast<float>(low + (high - low) * random.uniform());
}

Balls random_balls(Random& random, std::size_t count, double radius) {
    Balls balls;
    for (std::size_t i = 0; i < count; ++i) {
        balls.push_back(
            {between(random, -1, 1), between(random, -1, 1), between(random, -1, 1), between(random, 0, radius)});
    }
    return balls;
}

Points points_around(Random& random, const Vec3& middle, double half, std::size_t count) {
    Points points;
    for (std::size_t i = 0; i < count; ++i) {
        points.add({between(random, middle.x - half, middle.x + half),
                    between(random, middle.y - half, middle.y + half),
                    between(random, middle.z - half, middle.z + half)});
    }
    return points;
}

double power(const Ball& ball, const Vec3& p) {
    const Vec3 d = p - center_of(ball);
    return dot(d, d) - static_cast<double>(ball.r) * static_cast<double>(ball.r);
}

/// The ball with the least power at a point, in double precision.
std::int32_t nearest(const Balls& balls, const Vec3& p) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < balls.size(); ++i) {
        best = power(balls[i], p) < power(balls[best], p) ? i : best;
    }
    return static_cast<std::int32_t>(best);
}

bool has(const Rivals& rivals, std::int32_t index) {
    return std::find(rivals.index.begin(), rivals.index.end(), index) != rivals.index.end();
}

} // namespace

TEST(Rivals, NoneIsLeftOutThatHasTheLeastPowerAtAPoint) {
    Random random(1);
    for (int turn = 0; turn < 200; ++turn) {
        const Balls balls = random_balls(random, 1 + random.below(300), turn % 2 == 0 ? 0.3 : 1);
        const double half = std::pow(10.0, -4 * random.uniform());
        const Points points = points_around(random, {between(random, -1, 1), between(random, -1, 1), 0}, half, 40);
        Rivals few;
        RivalSearch().find(all_rivals(balls), points, 0, points.size(), few);
        ASSERT_GE(few.size(), 1u);
        ASSERT_TRUE(std::is_sorted(few.index.begin(), few.index.end()));
        for (std::size_t p = 0; p < points.size(); ++p) {
            EXPECT_TRUE(has(few, nearest(balls, points.at(p)))) << "turn " << turn;
        }
        for (std::size_t i = 0; i < few.size(); ++i) { // they are the balls that they say
            const Ball& ball = balls[static_cast<std::size_t>(few.index[i])];
            EXPECT_EQ(few.centers.at(i), center_of(ball));
            EXPECT_EQ(few.radius[i], ball.r);
        }
    }
}

TEST(Rivals, AreFewWherePointsAreClose) {
    Random random(2);
    const Balls balls = random_balls(random, 1000, 0.1);
    Rivals few;
    const Points points = points_around(random, {0.2, 0.1, -0.3}, 0.01, 20);
    RivalSearch().find(all_rivals(balls), points, 0, points.size(), few);
    EXPECT_LT(few.size(), 50u);
}

TEST(Rivals, OnlyThePointsOfTheRangeCount) {
    const Balls balls{{-1, 0, 0, 0.1f}, {1, 0, 0, 0.1f}};
    Points points;
    points.add({-1, 0, 0});
    points.add({1, 0, 0});
    Rivals left, right, both;
    RivalSearch search;
    search.find(all_rivals(balls), points, 0, 1, left);
    search.find(all_rivals(balls), points, 1, 2, right);
    search.find(all_rivals(balls), points, 0, 2, both);
    EXPECT_EQ(left.index, std::vector<std::int32_t>{0});
    EXPECT_EQ(right.index, std::vector<std::int32_t>{1});
    EXPECT_EQ(both.index, (std::vector<std::int32_t>{0, 1}));
}

TEST(Rivals, OfRivalsKeepTheirIndices) {
    Random random(3);
    const Balls balls = random_balls(random, 400, 0.3);
    const Points wide = points_around(random, {0, 0, 0}, 0.3, 60);
    Rivals some, few, at_once;
    RivalSearch search;
    search.find(all_rivals(balls), wide, 0, wide.size(), some);
    search.find(some, wide, 0, 10, few);
    search.find(all_rivals(balls), wide, 0, 10, at_once);
    for (std::size_t p = 0; p < 10; ++p) {
        EXPECT_TRUE(has(few, nearest(balls, wide.at(p))));
    }
    EXPECT_TRUE(std::includes(at_once.index.begin(), at_once.index.end(), few.index.begin(), few.index.end()));
}

TEST(Rivals, EqualBallsAndWhatIsNoNumberStay) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const Balls balls{{0, 0, 0, 1}, {0, 0, 0, 1}, {nan, 0, 0, 1}, {9, 0, 0, 1}};
    Points points;
    points.add({0.5, 0, 0});
    Rivals few;
    RivalSearch().find(all_rivals(balls), points, 0, 1, few);
    EXPECT_EQ(few.index, (std::vector<std::int32_t>{0, 1, 2}));
}
