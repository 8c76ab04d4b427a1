// Single balls that move to where they are worth more.
#include "cover/expect_contained.hpp"
#include "search/src/by_spheres/moves/moves.hpp"
#include "search/src/by_spheres/starts/starts.hpp"

#include <foam/runtime/contract.hpp>

#include <gtest/gtest.h>

namespace {

using namespace foam;
using namespace foam::by_spheres;

constexpr std::size_t pieces = 2000, points = 1500, first_points = 300, directions = 64;
constexpr int resolution = 32;

/// Two boxes far apart, and balls of which all but one are about the first.
struct Example {
    Example()
        : solid(sample::solids().at("TwoBoxes")()), problem(*solid, resolution, points, 0),
          improvement(problem, directions, first_points), skin(solid->surface(), problem.frame, pieces),
          coarse(solid->surface(), problem.frame) {
        const auto& vertices = solid->surface().vertices;
        const Vec3 one = problem.frame.to_unit(vertices.front()), other = problem.frame.to_unit(vertices.back());
        for (int k = 0; k < 5; ++k) {
            balls.push_back(ball_of({one + Vec3{0.01 * k, 0, 0}, 0.5}));
        }
        balls.push_back(ball_of({other, 0.5}));
    }
    RandomSwaps swaps() const { return {problem, improvement, skin, coarse}; }
    CoverCandidate settled() const { return ConditionalGradient(skin, problem.occupancy).improved(balls, 40); }

    std::shared_ptr<const Solid> solid;
    Problem problem;
    Improvement improvement;
    FineSurface skin;
    IndexedSurface coarse;
    Balls balls;
};

TEST(RandomSwaps, MoveBallsToAnotherPart) {
    const Example example;
    const CoverCandidate best = example.swaps().improved(example.balls, example.balls.size(), 24, 1, {});
    EXPECT_LE(best.balls.size(), example.balls.size());
    const double excess = example.settled().volume - example.problem.volume;
    EXPECT_LT(best.volume - example.problem.volume, 0.8 * excess);
    test::expect_contained(example.skin, best.balls);
}

TEST(RandomSwaps, AddMissingBalls) {
    Example example;
    example.balls = {example.balls.front(), example.balls.back()};
    const CoverCandidate best = example.swaps().improved(example.balls, 8, 1, 1, {});
    EXPECT_EQ(best.balls.size(), 8u);
    EXPECT_LT(best.volume, example.settled().volume);
    test::expect_contained(example.skin, best.balls);
}

TEST(RandomSwaps, NeverMakeBallsWorse) {
    const Example example;
    const RandomSwaps swaps = example.swaps();
    double before = swaps.improved(example.balls, example.balls.size(), 0, 1, {}).volume;
    for (const int tries : {1, 2, 4}) { // of so few, each begins with the best so far
        const double volume = swaps.improved(example.balls, example.balls.size(), tries, 1, {}).volume;
        EXPECT_LE(volume, before);
        before = volume;
    }
}

TEST(RandomSwaps, EndWhereTheSearchIsStopped) {
    const Example example;
    int asked = 0;
    const CoverCandidate best =
        example.swaps().improved(example.balls, example.balls.size(), 1000, 1, [&] { return ++asked > 2; });
    EXPECT_EQ(asked, 3);
    test::expect_contained(example.skin, best.balls);
}

} // namespace
