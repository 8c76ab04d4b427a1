#include "run/allocation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace foam {
namespace {

CostCurve curve_of(std::initializer_list<std::pair<std::size_t, double>> points) {
    CostCurve curve;
    for (const auto& [count, cost] : points) {
        curve.set(count, cost);
    }
    return curve;
}

TEST(CostCurve, ReturnsWhatItKnowsAndInterpolatesBetween) {
    const CostCurve curve = curve_of({{1, 8.0}, {4, 2.0}});
    EXPECT_EQ(curve.at(1), 8.0);
    EXPECT_EQ(curve.at(4), 2.0);
    // 8 n^-1 goes through both points.
    EXPECT_NEAR(curve.at(2), 4.0, 1e-12);
}

TEST(CostCurve, FallsBeyondTheLastKnownCount) {
    const CostCurve curve = curve_of({{2, 1.0}});
    EXPECT_NEAR(curve.at(4), std::pow(2.0, -0.4), 1e-12);
    EXPECT_EQ(curve.at(1), 1.0);
}

TEST(CostCurve, AZeroCostIsNoTrouble) {
    const CostCurve curve = curve_of({{1, 1.0}, {4, 0.0}});
    EXPECT_TRUE(std::isfinite(curve.at(2)));
    EXPECT_TRUE(std::isfinite(curve.at(8)));
}

TEST(Allocate, GivesSpheresToWhomTheyHelpMost) {
    const CostCurve useful = curve_of({{1, 10}, {2, 4}, {3, 2}, {4, 1}});
    const CostCurve useless = curve_of({{1, 1}, {2, 0.9}, {3, 0.8}, {4, 0.7}});
    const auto counts = allocate({{&useful, 1, 4}, {&useless, 1, 4}}, 5);
    EXPECT_EQ(counts, (std::vector<std::size_t>{4, 1}));
}

TEST(Allocate, FindsWhatAGreedyWalkMisses) {
    // The first extra sphere does nothing for a, the second everything.
    const CostCurve a = curve_of({{1, 10}, {2, 10}, {3, 0}});
    const CostCurve b = curve_of({{1, 3}, {2, 2}, {3, 1.5}});
    EXPECT_EQ(allocate({{&a, 1, 3}, {&b, 1, 3}}, 4), (std::vector<std::size_t>{3, 1}));
}

TEST(Allocate, IsOptimalAgainstBruteForce) {
    const CostCurve curves[] = {curve_of({{1, 7}, {2, 6.5}, {3, 2}, {4, 1.9}, {5, 0.1}}),
                                curve_of({{1, 9}, {2, 3}, {3, 2.9}, {4, 0.5}, {5, 0.4}}),
                                curve_of({{1, 4}, {2, 3}, {3, 2.2}, {4, 1.7}, {5, 1.5}})};
    for (std::size_t total = 3; total <= 15; ++total) {
        double best = std::numeric_limits<double>::infinity();
        for (std::size_t i = 1; i <= 5; ++i) {
            for (std::size_t j = 1; j <= 5; ++j) {
                const std::size_t k = total - i - j;
                if (i + j < total && k <= 5) {
                    best = std::min(best, curves[0].at(i) + curves[1].at(j) + curves[2].at(k));
                }
            }
        }
        const auto counts = allocate({{&curves[0], 1, 5}, {&curves[1], 1, 5}, {&curves[2], 1, 5}}, total);
        ASSERT_EQ(counts.size(), 3u) << total;
        EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), std::size_t{0}), total);
        EXPECT_DOUBLE_EQ(curves[0].at(counts[0]) + curves[1].at(counts[1]) + curves[2].at(counts[2]), best);
    }
}

TEST(AllocateAtMost, LeavesSpheresOutThatMakeItWorse) {
    const CostCurve falling = curve_of({{1, 10}, {2, 4}, {3, 2}});
    const CostCurve rising = curve_of({{1, 3}, {2, 3.5}, {3, 4}});
    EXPECT_EQ(allocate_at_most({{&falling, 1, 3}, {&rising, 1, 3}}, 6), (std::vector<std::size_t>{3, 1}));
    EXPECT_EQ(allocate_at_most({{&falling, 1, 3}, {&rising, 1, 3}}, 3), (std::vector<std::size_t>{2, 1}));
    EXPECT_TRUE(allocate_at_most({{&falling, 1, 3}, {&rising, 1, 3}}, 1).empty());
}

TEST(AllocateAtMost, TakesTheSpheresWhereTheDifferenceIsWithinTheError) {
    const CostCurve flat = curve_of({{1, 2}, {2, 1}, {3, 1.0005}});
    EXPECT_EQ(allocate_at_most({{&flat, 1, 3}}, 3), (std::vector<std::size_t>{3}));
}

TEST(AllocateAtMost, MoreIsNeverWorse) {
    const CostCurve a = curve_of({{1, 7}, {2, 8}, {3, 2}, {4, 5}, {5, 3}});
    const CostCurve b = curve_of({{1, 9}, {2, 3}, {3, 4}, {4, 3.5}, {5, 0.4}});
    double previous = std::numeric_limits<double>::infinity();
    for (std::size_t total = 2; total <= 10; ++total) {
        const auto counts = allocate_at_most({{&a, 1, 5}, {&b, 1, 5}}, total);
        ASSERT_EQ(counts.size(), 2u) << total;
        const double cost = a.at(counts[0]) + b.at(counts[1]);
        EXPECT_LE(cost, previous * 1.001) << total;
        previous = cost;
    }
}

TEST(Allocate, KeepsBoundsAndKnownCounts) {
    const CostCurve curve = curve_of({{1, 5}, {2, 3}, {4, 1}});
    EXPECT_EQ(allocate({{&curve, 2, 2}, {&curve, 1, 4}}, 6), (std::vector<std::size_t>{2, 4}));
    EXPECT_TRUE(allocate({{&curve, 1, 2}, {&curve, 1, 2}}, 5).empty());
    EXPECT_TRUE(allocate({{&curve, 3, 3, true}}, 3).empty());
    EXPECT_EQ(allocate({{&curve, 1, 4, true}}, 4), (std::vector<std::size_t>{4}));
}

} // namespace
} // namespace foam
