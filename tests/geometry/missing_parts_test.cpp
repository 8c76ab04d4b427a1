// The volume outside of balls that change one by one is that of the balls at once.
#include "geometry/shapes.hpp"

#include <foam/geometry/internal/measure_parts.hpp>

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::geometry;
using namespace foam::test;

namespace {

Sphere random_ball(Random& random) {
    return {random_point(random, {{-1.2, -1.2, -1.2}, {1.2, 1.2, 1.2}}), 0.05 + 0.6 * random.uniform()};
}

std::vector<std::shared_ptr<const Solid>> solids() {
    return {Solid::make(box({-1, -0.5, -0.25}, {1, 0.5, 0.25})), Solid::make(ball({}, 1, 10)),
            Solid::make(ball({0.5, 0, 0}, 0.3, 6))};
}

} // namespace

TEST(MissingParts, WithoutBallsAreTheSolid) {
    for (const auto& solid : solids()) {
        const MissingParts parts(*solid);
        EXPECT_EQ(parts.volume(), solid->missing_volume({}));
        EXPECT_NEAR(parts.volume(), solid->volume(), 0.03 * solid->volume());
    }
}

TEST(MissingParts, AreBitwiseThoseOfAllBallsAtOnceAfterAnyChange) {
    for (const auto& solid : solids()) {
        Random random(5);
        MissingParts parts(*solid);
        std::vector<Sphere> balls;
        for (int turn = 0; turn < 60; ++turn) {
            const std::size_t what = random.below(4);
            if (what == 0 || balls.empty()) {
                balls.push_back(random_ball(random));
            } else if (what == 1) {
                balls.erase(balls.begin() + static_cast<std::ptrdiff_t>(random.below(balls.size())));
            } else if (what == 2) {
                balls[random.below(balls.size())] = random_ball(random);
            } else { // one of them alone, slightly
                balls[random.below(balls.size())].radius *= 1.01;
            }
            parts.take(balls);
            ASSERT_EQ(parts.volume(), solid->missing_volume(balls))
                << "turn " << turn << ", " << balls.size() << " balls";
        }
        parts.take(balls);
        EXPECT_EQ(parts.volume(), solid->missing_volume(balls)) << "nothing changed";
        parts.take({});
        EXPECT_EQ(parts.volume(), solid->missing_volume({})) << "all gone";
    }
}

TEST(MissingParts, WithOneBallSplitIntoTwo) {
    for (const auto& solid : solids()) {
        Random random(6);
        MissingParts parts(*solid);
        std::vector<Sphere> balls;
        for (int i = 0; i < 12; ++i) {
            balls.push_back(random_ball(random));
        }
        parts.take(balls);
        const double before = parts.volume();
        double changes = 0;
        for (std::size_t i = 0; i < balls.size(); ++i) {
            const Sphere first = random_ball(random), second = random_ball(random);
            std::vector<Sphere> split = balls;
            split[i] = first;
            split.push_back(second);
            EXPECT_NEAR(parts.volume_with(i, first, second), solid->missing_volume(split), 1e-12 * solid->volume());
            changes += std::abs(solid->missing_volume(split) - before);
        }
        EXPECT_GT(changes, 0.01 * solid->volume()) << "the splits matter";
        EXPECT_EQ(parts.volume(), before) << "nothing is taken";
    }
}

TEST(MissingParts, ABallAroundAllLeavesNothing) {
    for (const auto& solid : solids()) {
        MissingParts parts(*solid);
        parts.take(std::vector<Sphere>{{{0, 0, 0}, 3}});
        EXPECT_EQ(parts.volume(), 0);
    }
}
