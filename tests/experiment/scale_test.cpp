// Scales of plots: which ticks and labels they have, and where they end.
#include "report/src/plot/scale.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace foam::plot {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> labels(const Scale& scale) {
    std::vector<std::string> texts;
    for (const Tick& tick : scale.ticks) {
        if (!tick.label.empty()) {
            texts.push_back(tick.label);
        }
    }
    return texts;
}

TEST(Scale, DecadesAreLabelled) {
    const Scale scale = scale_over({"", true, {}}, {500, 3000, 1e6});
    EXPECT_EQ(scale.low, 500);
    EXPECT_EQ(scale.high, 1e6);
    EXPECT_THAT(labels(scale), ElementsAre("1000", "10k", "100k", "1M"));
    EXPECT_EQ(scale.position(500), 0);
    EXPECT_EQ(scale.position(1e6), 1);
    EXPECT_NEAR(scale.position(5e4) - scale.position(5e3), scale.position(5e3) - scale.position(500), 1e-12);
}

TEST(Scale, NarrowRangesHaveTwosAndFives) {
    const Scale scale = scale_over({"", true, {}}, {0.03, 0.4});
    EXPECT_EQ(scale.low, 0.02);
    EXPECT_EQ(scale.high, 0.5);
    EXPECT_THAT(labels(scale), ElementsAre("0.02", "0.05", "0.1", "0.2", "0.5"));
}

TEST(Scale, RoundEndsAreKept) {
    for (const double value : {0.001, 0.002, 0.005, 0.01, 0.1, 1.0, 2.0, 10.0, 1000.0}) {
        EXPECT_EQ(scale_over({"", true, {}}, {value, 1e4}).low, value);
    }
}

TEST(Scale, LinearOnesBeginAtZero) {
    const Scale scale = scale_over({"", false, {}}, {3, 17});
    EXPECT_EQ(scale.low, 0);
    EXPECT_EQ(scale.high, 18);
    EXPECT_THAT(labels(scale), ElementsAre("0", "2", "4", "6", "8", "10", "12", "14", "16", "18"));
}

TEST(Scale, GivenTicks) {
    const Scale scale = scale_over({"", true, {1, 2, 4, 8}}, {2, 4});
    EXPECT_THAT(labels(scale), ElementsAre("1", "2", "4", "8"));
    EXPECT_EQ(scale.low, 1);
    EXPECT_EQ(scale.high, 8);
}

TEST(Scale, NothingToDraw) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const std::vector<double>& values : {std::vector<double>{}, {0, -1}, {nan}, {5}, {5, 5}}) {
        const Scale scale = scale_over({"", true, {}}, values);
        EXPECT_LT(scale.low, scale.high);
        EXPECT_GT(scale.low, 0);
    }
}

} // namespace
} // namespace foam::plot
