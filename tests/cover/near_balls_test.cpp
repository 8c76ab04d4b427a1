// The neighbours of balls that move, and the exposed directions that follow from them.
#include "search/src/by_spheres/measured/points.hpp"
#include "search/src/by_spheres/moves/near_balls.hpp"

#include <foam/base/random.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace foam;
using namespace foam::search::by_spheres;

float between(Random& random, float low, float high) {
    return low + (high - low) * static_cast<float>(random.uniform());
}

Balls balls_at_random(std::size_t count, Random& random) {
    Balls balls;
    for (std::size_t i = 0; i < count; ++i) {
        balls.push_back({between(random, -1, 1), between(random, -1, 1), between(random, -1, 1),
                         i % 10 == 0 ? 0.5f : between(random, 0.01f, 0.2f)});
    }
    return balls;
}

void move(Balls& balls, float step, Random& random) {
    for (Ball& ball : balls) {
        ball.x += between(random, -step, step);
        ball.y += between(random, -step, step);
        ball.z += between(random, -step, step);
        ball.r = std::max(0.0f, ball.r + between(random, -step, step));
    }
}

/// Returns how many neighbours the lists contain.
std::size_t expect_all_within(NearBalls& near, const Balls& balls, float gap) {
    std::size_t listed = 0;
    for (std::uint32_t i = 0; i < balls.size(); ++i) {
        const auto list = near.of(i, gap);
        listed += list.size();
        EXPECT_TRUE(std::is_sorted(list.begin(), list.end()));
        for (std::uint32_t k = 0; k < balls.size(); ++k) {
            if (k != i && std::sqrt(squared_distance(balls[i], balls[k])) < balls[i].r + balls[k].r + gap) {
                EXPECT_TRUE(std::binary_search(list.begin(), list.end(), k)) << i << " and " << k;
            }
        }
    }
    return listed;
}

TEST(NearBalls, AreAllThatMeetWhileBallsMove) {
    Random random(1);
    Balls balls = balls_at_random(200, random);
    NearBalls near;
    for (const float step : {0.0f, 0.002f, 0.002f, 0.01f, 0.3f, 0.001f}) {
        move(balls, step, random);
        near.update(balls);
        EXPECT_LT(expect_all_within(near, balls, 0), balls.size() * balls.size() / 2) << "few of all";
        expect_all_within(near, balls, 0.01f);
        expect_all_within(near, balls, 1);
    }
}

TEST(NearBalls, AreFewAlsoBeyondTheLists) {
    Random random(4);
    Balls balls = balls_at_random(400, random);
    for (Ball& ball : balls) {
        ball.r /= 8;
    }
    NearBalls near;
    for (const float gap : {0.0f, 0.1f, 0.05f}) {
        move(balls, 0.001f, random);
        near.update(balls, gap);
        EXPECT_GE(near.listed_gap(), gap);
        EXPECT_LT(expect_all_within(near, balls, gap), balls.size() * balls.size() / 20);
        EXPECT_LT(expect_all_within(near, balls, 0.2f), balls.size() * balls.size() / 10);
        EXPECT_EQ(expect_all_within(near, balls, 4), balls.size() * (balls.size() - 1));
    }
}

TEST(NearBalls, FollowTheNumberOfBalls) {
    Random random(2);
    NearBalls near;
    for (const std::size_t count : {30, 31, 1, 12}) {
        const Balls balls = balls_at_random(count, random);
        near.update(balls);
        expect_all_within(near, balls, 0);
    }
}

TEST(NearBalls, LeaveTheSameDirectionsExposed) {
    Random random(3);
    const Balls balls = balls_at_random(60, random);
    const Points directions = spread_directions(67, 0); // not a multiple of eight
    NearBalls near;
    near.update(balls);
    Exposed by_all, by_near;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const bool shows = by_all.look(balls, i, directions);
        ASSERT_EQ(by_near.look(balls, i, directions, near.of(i)), shows);
        if (!shows) {
            continue;
        }
        ASSERT_EQ(by_near.depth(), by_all.depth());
        for (std::size_t k = 0; k < directions.size(); ++k) {
            const Ball& ball = balls[i];
            const float x = ball.x + ball.r * directions.x[k], y = ball.y + ball.r * directions.y[k],
                        z = ball.z + ball.r * directions.z[k];
            float least = 1e9f;
            for (std::size_t j = 0; j < balls.size(); ++j) {
                if (j != i) {
                    least = std::min(least, balls[j].squared_distance(x, y, z) - balls[j].r * balls[j].r);
                }
            }
            if (std::abs(least) > 1e-4f) {
                EXPECT_EQ(by_all.depth()[k] > 0, least > 0);
            }
        }
    }
}

} // namespace
