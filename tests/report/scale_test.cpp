// Axes of the report's pictures: their ends and ticks.
#include "report/src/scale.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace foam::plot {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> labels(const Scale& scale) {
    std::vector<std::string> texts;
    for (const Tick& tick : scale.ticks) {
        texts.push_back(tick.label);
    }
    return texts;
}

TEST(Scale, BeginsAtZeroAndEndsOnATick) {
    const Scale scale = scale_over({3, 17});
    EXPECT_EQ(scale.low, 0);
    EXPECT_EQ(scale.high, 18);
    EXPECT_EQ(scale.position(9), 0.5);
    EXPECT_THAT(labels(scale), ElementsAre("0", "2", "4", "6", "8", "10", "12", "14", "16", "18"));
}

TEST(Scale, LargeNumbersAreShort) {
    EXPECT_THAT(labels(scale_over({20000})),
                ElementsAre("0", "2000", "4000", "6000", "8000", "10k", "12k", "14k", "16k", "18k", "20k"));
    EXPECT_EQ(tick_label(3e6), "3M");
}

TEST(Scale, NothingToDraw) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const std::vector<double>& values : {std::vector<double>{}, {0}, {nan}, {5}, {-1}}) {
        const Scale scale = scale_over(values);
        EXPECT_LT(scale.low, scale.high);
        EXPECT_GE(scale.ticks.size(), 2U);
    }
}

} // namespace
} // namespace foam::plot
