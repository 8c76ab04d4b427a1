#include "bench/src/power_law.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace foam::experiment {
namespace {

using Points = std::vector<std::pair<double, double>>;

TEST(PowerLaw, FindsAnExactOne) {
    Points points;
    for (const double x : {1e3, 2e3, 5e3, 1e4}) {
        points.emplace_back(x, 3e-6 * std::pow(x, 1.25));
    }
    const auto law = fitted_power_law(points);
    ASSERT_TRUE(law);
    EXPECT_NEAR(law->exponent, 1.25, 1e-12);
    EXPECT_NEAR(law->factor, 3e-6, 1e-15);
    EXPECT_EQ(law->from, 1e3);
    EXPECT_EQ(law->to, 1e4);
}

TEST(PowerLaw, LooksAtTheUpperRangeOnly) {
    Points points{{10, 1}, {100, 1}, {900, 1}}; // a constant cost at first
    for (const double x : {1e3, 2e3, 5e3, 1e4}) {
        points.emplace_back(x, x * x);
    }
    EXPECT_NEAR(fitted_power_law(points).value().exponent, 2, 1e-12);
}

TEST(PowerLaw, LeastSquaresInTheLogarithms) {
    // The slope of (0, 0), (1, 2), (2, 1) is 1/2, whatever the base.
    const double b = 2;
    EXPECT_NEAR(fitted_power_law({{1, 1}, {b, b * b}, {b * b, b}}).value().exponent, 0.5, 1e-12);
}

TEST(PowerLaw, NeedsThreePointsAboveZero) {
    EXPECT_FALSE(fitted_power_law({}));
    EXPECT_FALSE(fitted_power_law({{1, 1}, {2, 2}}));
    EXPECT_FALSE(fitted_power_law({{1, 1}, {2, 2}, {3, 0}}));
    EXPECT_FALSE(fitted_power_law({{1, 1}, {50, 2}, {100, 3}}));
    EXPECT_FALSE(fitted_power_law({{5, 1}, {5, 2}, {5, 3}}));
}

} // namespace
} // namespace foam::experiment
