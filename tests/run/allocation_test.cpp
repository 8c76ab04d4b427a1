#include "runtime/src/allocate/allocation.hpp"

#include <foam/base/random.hpp>

#include <gtest/gtest.h>

#include <limits>

namespace foam {
namespace {

CostCurve curve_of(std::initializer_list<std::pair<std::size_t, double>> points) {
    CostCurve curve;
    for (const auto& [count, cost] : points) {
        curve.set(count, {0, cost});
    }
    return curve;
}

/// The counts of curves that all weigh the same.
std::vector<std::size_t> allocate_at_most(std::initializer_list<const CostCurve*> curves, std::size_t total) {
    std::vector<WeightedCurve> weighted_curves;
    for (const CostCurve* curve : curves) {
        weighted_curves.push_back({curve});
    }
    return Allocation(weighted_curves, total).best();
}

TEST(CostCurve, DemandFallsWithThePrice) {
    const CostCurve curve = curve_of({{1, 10}, {2, 9}, {3, 4}, {4, 3.5}, {5, 3.5}});
    EXPECT_EQ(curve.demand(100), 1u);
    EXPECT_EQ(curve.demand(3), 3u) << "two at once save six";
    EXPECT_EQ(curve.demand(0.5), 4u) << "of equal sums the largest";
    EXPECT_EQ(curve.demand(0.4), 4u);
    EXPECT_EQ(curve.demand(0), 5u);
    EXPECT_EQ(curve.least(), (Cost{0, 3.5}));
    EXPECT_EQ(curve.demand(1, 2), 4u) << "twice the weight is half the price";
}

TEST(CostCurve, TheLimitIsKeptAtAnyPrice) {
    CostCurve curve;
    curve.set(1, {0.02, 1});
    curve.set(2, {0.01, 0.5});
    curve.set(3, {0, 9});
    EXPECT_EQ(curve.least(), (Cost{0, 9}));
    EXPECT_EQ(curve.demand(100), 3u);
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
                curve.set(count, {0, random.uniform()});
            }
        }
        double previous = std::numeric_limits<double>::infinity();
        for (std::size_t total = 3; total <= 25; ++total) {
            double best = std::numeric_limits<double>::infinity();
            for (const std::size_t i : counts) {
                for (const std::size_t j : counts) {
                    for (const std::size_t k : counts) {
                        if (i + j + k <= total) {
                            best = std::min(best, curves[0].known().at(i).volume + curves[1].known().at(j).volume +
                                                      curves[2].known().at(k).volume);
                        }
                    }
                }
            }
            const auto shared = allocate_at_most({&curves[0], &curves[1], &curves[2]}, total);
            ASSERT_EQ(shared.size(), 3u) << total;
            EXPECT_LE(shared[0] + shared[1] + shared[2], total);
            const double cost = curves[0].known().at(shared[0]).volume + curves[1].known().at(shared[1]).volume +
                                curves[2].known().at(shared[2]).volume;
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

TEST(Allocation, AWeightDrawsSpheres) {
    const CostCurve curve = curve_of({{1, 10}, {2, 6}, {3, 4}, {4, 3}});
    EXPECT_EQ(Allocation({{&curve, 1}, {&curve, 10}}, 5).best(), (std::vector<std::size_t>{1, 4}));
    EXPECT_EQ(Allocation({{&curve, 10}, {&curve, 1}}, 5).best(), (std::vector<std::size_t>{4, 1}));
    EXPECT_EQ(Allocation({{&curve, 0}, {&curve, 1}}, 8).best(), (std::vector<std::size_t>{1, 4})) << "nothing to gain";
    EXPECT_EQ(Allocation({{&curve, 3}, {&curve, 1}}, 8).cost({1, 4}), (Cost{0, 13})) << "as it is, without weights";
}

TEST(Allocation, ALimitComesBeforeVolume) {
    const CostCurve free = curve_of({{1, 10}, {2, 4}, {3, 2}});
    CostCurve tight;
    tight.set(1, {0.02, 1});
    tight.set(2, {0.01, 1});
    tight.set(3, {0, 1});
    EXPECT_EQ(Allocation({{&free}, {&tight}}, 4).best(), (std::vector<std::size_t>{1, 3}));
    EXPECT_EQ(Allocation({{&free}, {&tight}}, 3).best(), (std::vector<std::size_t>{1, 2})) << "as near as there are";
    EXPECT_EQ(Allocation({{&free}, {&tight}}, 9).fewest(100), (std::vector<std::size_t>{1, 3}));
}

TEST(Allocation, TheFewestThatAreEnough) {
    const CostCurve a = curve_of({{1, 10}, {2, 4}, {3, 2}, {4, 1}});
    const CostCurve b = curve_of({{1, 3}, {2, 2}, {3, 1.5}});
    const Allocation sharing({{&a}, {&b}}, 100);
    EXPECT_EQ(sharing.fewest(13), (std::vector<std::size_t>{1, 1}));
    EXPECT_EQ(sharing.fewest(7), (std::vector<std::size_t>{2, 1}));
    EXPECT_EQ(sharing.fewest(6.99), (std::vector<std::size_t>{3, 1}));
    EXPECT_EQ(sharing.fewest(2.5), (std::vector<std::size_t>{4, 3}));
    EXPECT_TRUE(sharing.fewest(2.49).empty());
    EXPECT_TRUE(Allocation({{&a}, {&b}}, 4).fewest(4).empty()) << "more than there are";
    EXPECT_TRUE(Allocation({{&a}, {&b}}, 1).fewest(100).empty());
}

TEST(Rungs, AreThoseOfALadderWithinBounds) {
    const auto ladder = [](std::size_t least, std::size_t most, std::size_t rungs, Rungs kind = Rungs::dense) {
        std::vector<std::size_t> all;
        while (all.size() < rungs) {
            const auto next = next_rungs(all.empty() ? 0 : all.back(), least, most, kind);
            if (next.empty()) {
                break;
            }
            all.insert(all.end(), next.begin(), next.end());
        }
        return all;
    };
    EXPECT_EQ(ladder(1, SIZE_MAX, 22), (std::vector<std::size_t>{1,  2,  3,  4,  5,  6,  7,  8,  10, 12, 14,
                                                                 16, 20, 24, 28, 32, 40, 48, 56, 64, 96, 128}));
    EXPECT_EQ(ladder(1, 11, 22), (std::vector<std::size_t>{1, 2, 3, 4, 5, 6, 7, 8, 10, 11}));
    EXPECT_EQ(ladder(9, 21, 22), (std::vector<std::size_t>{9, 10, 12, 14, 16, 20, 21}));
    EXPECT_EQ(ladder(3, 3, 22), (std::vector<std::size_t>{3}));
    EXPECT_EQ(ladder(1, SIZE_MAX, 11, Rungs::sparse), (std::vector<std::size_t>{1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48}));
    EXPECT_EQ(ladder(5, 14, 11, Rungs::sparse), (std::vector<std::size_t>{5, 6, 8, 12, 14}));
}

} // namespace
} // namespace foam
