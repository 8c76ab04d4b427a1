#include "bench/src/queries/statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace foam {
namespace {

EngineAnswer answer(bool obstacle, bool itself) {
    EngineAnswer result;
    result.state = EngineAnswer::State::answered;
    result.hits_obstacle = obstacle;
    result.hits_itself = itself;
    return result;
}

TEST(Comparison, VerdictsAreSplit) {
    EngineAnswer aborted;
    aborted.state = EngineAnswer::State::aborted;
    const EngineComparison c = compare_models({{answer(false, false), answer(true, false)},
                                               {answer(false, false), answer(true, true)},
                                               {answer(false, true), answer(true, true)},
                                               {answer(true, false), answer(false, false)},
                                               {answer(true, true), aborted}});
    EXPECT_EQ(c.queries(), 4u);
    EXPECT_EQ(c.collides.holds[0], 2u);
    EXPECT_EQ(c.collides.holds[1], 3u);
    EXPECT_EQ(c.collides.only_spheres, 2u);
    EXPECT_EQ(c.collides.only_original, 1u);
    EXPECT_EQ(c.hits_obstacle.only_spheres, 3u);
    EXPECT_EQ(c.hits_obstacle.only_original, 1u);
    EXPECT_EQ(c.hits_itself.holds[0], 1u);
    EXPECT_EQ(c.hits_itself.holds[1], 2u);
    EXPECT_DOUBLE_EQ(c.collides.difference.value(), 0.25);
    EXPECT_DOUBLE_EQ(c.hits_obstacle.difference.value(), 0.5);
    EXPECT_DOUBLE_EQ(c.hits_itself.difference.value(), 0.25);
    // The differences 1, 1, 0, -1 have a variance of 11/12; of their mean, a quarter of that.
    EXPECT_NEAR(c.collides.difference.error(), std::sqrt(11.0 / 48.0), 1e-15);
}

} // namespace
} // namespace foam
