// The counts along which covering spheres build on one another.
#include "search/src/by_spheres/portfolio/problem.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace {

using namespace foam::search::by_spheres;

std::vector<std::size_t> below(std::size_t count, std::size_t (*before)(std::size_t)) {
    std::vector<std::size_t> counts;
    while (count > 1) {
        counts.push_back(count = before(count));
    }
    return counts;
}

TEST(Ladder, EveryCountUpToEightThenFewer) {
    const std::vector<std::size_t> all{64, 56, 48, 40, 32, 28, 24, 20, 16, 14, 12, 10, 8, 7, 6, 5, 4, 3, 2, 1};
    EXPECT_EQ(below(65, count_before), all);
    EXPECT_EQ(below(5000, count_before), all);
    EXPECT_EQ(below(15, count_before).front(), 14u);
    EXPECT_EQ(below(47, count_before).front(), 40u);
}

TEST(Ladder, FastHasFewerAboveEight) {
    const std::vector<std::size_t> all{64, 32, 16, 8, 7, 6, 5, 4, 3, 2, 1};
    EXPECT_EQ(below(5000, quick_count_before), all);
    EXPECT_EQ(below(17, quick_count_before).front(), 16u);
    EXPECT_EQ(below(63, quick_count_before).front(), 32u);
}

} // namespace
