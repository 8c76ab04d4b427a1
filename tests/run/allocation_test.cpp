#include "run/allocation.hpp"

#include <foam/random.hpp>

#include <gtest/gtest.h>

#include <limits>

namespace foam {
namespace {

CostCurve curve_of(std::initializer_list<std::pair<std::size_t, double>> points) {
    CostCurve curve;
    for (const auto& [count, cost] : points) {
        curve.set(count, cost);
    }
    return curve;
}

TEST(CostCurve, DemandFallsWithThePrice) {
    const CostCurve curve = curve_of({{1, 10}, {2, 9}, {3, 4}, {4, 3.5}, {5, 3.5}});
    EXPECT_EQ(curve.demand(100), 1u);
    EXPECT_EQ(curve.demand(3), 3u) << "two at once save six";
    EXPECT_EQ(curve.demand(0.5), 4u) << "of equal sums the largest";
    EXPECT_EQ(curve.demand(0.4), 4u);
    EXPECT_EQ(curve.demand(0), 5u);
    EXPECT_EQ(curve.least(), 3.5);
}

TEST(Allocate, GivesSpheresToWhomTheyHelpMost) {
    const CostCurve useful = curve_of({{1, 10}, {2, 4}, {3, 2}, {4, 1}});
    const CostCurve useless = curve_of({{1, 1}, {2, 0.9}, {3, 0.8}, {4, 0.7}});
    EXPECT_EQ(allocate_at_most({&useful, &useless}, 5), (std::vector<std::size_t>{4, 1}));
}

TEST(Allocate, FindsWhatAGreedyWalkMisses) {
    // The first extra sphere does nothing for a, the second everything.
    const CostCurve a = curve_of({{1, 10}, {2, 10}, {3, 0}});
    const CostCurve b = curve_of({{1, 3}, {2, 2}, {3, 1.5}});
    EXPECT_EQ(allocate_at_most({&a, &b}, 4), (std::vector<std::size_t>{3, 1}));
}

TEST(Allocate, IsOptimalAgainstBruteForce) {
    const std::size_t counts[] = {1, 2, 3, 5, 8};
    Random random(3);
    for (int round = 0; round < 20; ++round) {
        CostCurve curves[3];
        for (CostCurve& curve : curves) {
            for (const std::size_t count : counts) {
                curve.set(count, random.uniform());
            }
        }
        double previous = std::numeric_limits<double>::infinity();
        for (std::size_t total = 3; total <= 25; ++total) {
            double best = std::numeric_limits<double>::infinity();
            for (const std::size_t i : counts) {
                for (const std::size_t j : counts) {
                    for (const std::size_t k : counts) {
                        if (i + j + k <= total) {
                            best = std::min(best, curves[0].known().at(i) + curves[1].known().at(j) +
                                                      curves[2].known().at(k));
                        }
                    }
                }
            }
            const auto shared = allocate_at_most({&curves[0], &curves[1], &curves[2]}, total);
            ASSERT_EQ(shared.size(), 3u) << total;
            EXPECT_LE(shared[0] + shared[1] + shared[2], total);
            const double cost =
                curves[0].known().at(shared[0]) + curves[1].known().at(shared[1]) + curves[2].known().at(shared[2]);
            EXPECT_DOUBLE_EQ(cost, best);
            EXPECT_LE(cost, previous) << "more is never worse";
            previous = cost;
        }
    }
}

TEST(Allocate, LeavesSpheresOutThatMakeItWorse) {
    const CostCurve falling = curve_of({{1, 10}, {2, 4}, {3, 2}});
    const CostCurve rising = curve_of({{1, 3}, {2, 3}, {3, 4}});
    EXPECT_EQ(allocate_at_most({&falling, &rising}, 6), (std::vector<std::size_t>{3, 1}));
    EXPECT_EQ(allocate_at_most({&falling, &rising}, 3), (std::vector<std::size_t>{2, 1}));
    EXPECT_TRUE(allocate_at_most({&falling, &rising}, 1).empty());
}

TEST(Rungs, AreThoseOfALadderWithinBounds) {
    const auto ladder = [](std::size_t least, std::size_t most, std::size_t rungs) {
        std::vector<std::size_t> all;
        while (all.size() < rungs) {
            const auto next = next_rungs(all.empty() ? 0 : all.back(), least, most);
            if (next.empty()) {
                break;
            }
            all.insert(all.end(), next.begin(), next.end());
        }
        return all;
    };
    EXPECT_EQ(ladder(1, SIZE_MAX, 22), (std::vector<std::size_t>{1,  2,  3,  4,  5,  6,  7,  8,  10, 12, 14,
                                                                 16, 20, 24, 28, 32, 40, 48, 56, 64, 80, 96}));
    EXPECT_EQ(ladder(1, 11, 22), (std::vector<std::size_t>{1, 2, 3, 4, 5, 6, 7, 8, 10, 11}));
    EXPECT_EQ(ladder(9, 21, 22), (std::vector<std::size_t>{9, 10, 12, 14, 16, 20, 21}));
    EXPECT_EQ(ladder(3, 3, 22), (std::vector<std::size_t>{3}));
}

} // namespace
} // namespace foam
