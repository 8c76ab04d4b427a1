// foam::hypot(): right, at the ends of the numbers too, and the same bits everywhere.
#include <foam/base/hypot.hpp>
#include <foam/base/random.hpp>

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

namespace foam {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();

TEST(Hypot, IsTheLengthOfAPair) {
    EXPECT_EQ(hypot(3, 4), 5);
    EXPECT_EQ(hypot(-3, -4), 5);
    EXPECT_EQ(hypot(0, -2), 2);
    EXPECT_EQ(hypot(0, 0), 0);
    EXPECT_EQ(hypot(0x3p-1074, 0x4p-1074), 0x5p-1074);
    EXPECT_EQ(hypot(0x3p1000, 0x4p1000), 0x5p1000);
    EXPECT_EQ(hypot(1.7e308, 1.7e308), infinity);
    EXPECT_EQ(hypot(nan, -infinity), infinity);
    EXPECT_EQ(hypot(infinity, 0), infinity);
    EXPECT_TRUE(std::isnan(hypot(nan, 1)));
}

/// Returns a number of random sign, of a size from 2^-range to 2^range.
double any_number(Random& random, double range) {
    return (2 * random.uniform() - 1) * std::exp2(range * (2 * random.uniform() - 1));
}

TEST(Hypot, IsWrongByLessThanAUnit) {
    Random random(1);
    for (int i = 0; i < 300'000; ++i) {
        const double x = any_number(random, 12), y = any_number(random, 12), length = hypot(x, y);
        const long double exact = std::sqrt(static_cast<long double>(x) * x + static_cast<long double>(y) * y);
        const double unit = std::nextafter(length, infinity) - length;
        ASSERT_LT(std::abs(static_cast<double>(length - exact)), unit) << x << " " << y;
    }
}

TEST(Hypot, HasTheSameBitsEverywhere) {
    Random random(2);
    std::uint64_t digest = 0;
    for (int i = 0; i < 300'000; ++i) {
        // Without exp2, whose bits are the C library's.
        const double x = std::ldexp(random.uniform(), i % 40 - 20), y = random.uniform();
        digest = digest * 0x9e3779b97f4a7c15U + std::bit_cast<std::uint64_t>(hypot(x, y));
    }
    EXPECT_EQ(digest, 16119701309853412670U);
}

} // namespace
} // namespace foam
