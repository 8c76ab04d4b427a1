#include <foam/report/html_page.hpp>

#include <gtest/gtest.h>

#include <limits>

namespace foam {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(BarScale, IsLinearFromZero) {
    const BarScale scale({2, 0.5, 0, infinity, 4});
    EXPECT_FALSE(scale.logarithmic());
    EXPECT_EQ(scale.share(4), 1);
    EXPECT_EQ(scale.share(1), 0.25);
    EXPECT_EQ(scale.share(0), 0);
    EXPECT_EQ(scale.share(infinity), 1);
    EXPECT_EQ(scale.svg(0), "");
    EXPECT_NE(scale.svg(1).find("<rect width=\"25.0\" height=\"4\"/>"), std::string::npos);
}

TEST(BarScale, IsLogarithmicWhereNumbersSpanDecades) {
    const BarScale scale({0.1, 10, 0});
    EXPECT_TRUE(scale.logarithmic());
    EXPECT_NEAR(scale.lowest(), 0.01, 1e-15); // the least has a bar
    EXPECT_EQ(scale.greatest(), 10);
    EXPECT_NEAR(scale.share(0.1), 1.0 / 3, 1e-12);
    EXPECT_NEAR(scale.share(1), 2.0 / 3, 1e-12);
    EXPECT_EQ(scale.share(10), 1);
    EXPECT_EQ(scale.share(0), 0);
    EXPECT_FALSE(BarScale({0.1, 10}, 0, true).logarithmic());
}

TEST(BarScale, WhatReadsZeroDoesNotCount) {
    const BarScale scale({1e-9, 1, 2}, 1e-3);
    EXPECT_FALSE(scale.logarithmic());
    EXPECT_EQ(scale.share(1e-9), 0);
    EXPECT_TRUE(BarScale({1e-9}, 1e-3).empty());
    EXPECT_EQ(BarScale({}).svg(1), "");
}

TEST(Page, ItsTitleIsText) {
    const std::string page = html_page("a <b> & \"c\"", "");
    EXPECT_NE(page.find("<title>a &lt;b&gt; &amp; &quot;c&quot;</title>"), std::string::npos) << page;
}

} // namespace
} // namespace foam
