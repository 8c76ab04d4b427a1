// Ticks of the colour bar.
#include "scale.hpp"

#include <gtest/gtest.h>

namespace {

using foam::snapshot::make_scale;
using foam::snapshot::Scale;

std::vector<std::string> labels(const Scale& scale) {
    std::vector<std::string> result;
    for (const auto& tick : scale.ticks) {
        result.push_back(tick.label);
    }
    return result;
}

TEST(ColourBarScale, MillimetresForParts) {
    const Scale scale = make_scale(0.021, 0.0594);
    EXPECT_EQ(scale.unit, "mm");
    EXPECT_EQ(labels(scale), (std::vector<std::string>{"30", "40", "50"}));
}

TEST(ColourBarScale, MetresFromOneMetreOn) {
    const Scale scale = make_scale(0.2, 1.0);
    EXPECT_EQ(scale.unit, "m");
    EXPECT_EQ(labels(scale), (std::vector<std::string>{"0.2", "0.4", "0.6", "0.8", "1.0"}));
}

TEST(ColourBarScale, TicksLieWithinTheRadiiAtAnyScale) {
    for (const double most : {3e-8, 1e-7, 2e-4, 0.05, 0.9996, 7.0, 1e4, 1e12}) {
        for (const double share : {0.001, 0.5, 0.9, 0.99999}) {
            const Scale scale = make_scale(share * most, most);
            EXPECT_GE(scale.ticks.size(), 2u) << most << ' ' << share;
            EXPECT_LE(scale.ticks.size(), 9u) << most << ' ' << share;
            for (std::size_t i = 0; i < scale.ticks.size(); ++i) {
                EXPECT_GE(scale.ticks[i].value, share * most * (1 - 1e-9));
                EXPECT_LE(scale.ticks[i].value, most * (1 + 1e-9));
                EXPECT_LE(scale.ticks[i].label.size(), 14u) << scale.ticks[i].label;
                if (i > 0) {
                    EXPECT_NE(scale.ticks[i].label, scale.ticks[i - 1].label) << "two ticks that read the same";
                }
            }
        }
    }
}

TEST(ColourBarScale, OneTickForEqualRadii) {
    const Scale scale = make_scale(0.0345, 0.0345);
    EXPECT_EQ(labels(scale), (std::vector<std::string>{"34.50"}));
}

} // namespace
