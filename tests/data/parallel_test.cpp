// Work on all cores. Built with the thread sanitizer, these say that it sees how work is handed over.
#include <foam/base/parallel.hpp>

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace foam {
namespace {

TEST(Parallel, CallsTheBodyOnceForEveryIndex) {
    const auto shared = std::make_shared<const std::vector<int>>(1000, 7);
    std::vector<int> calls(shared->size());
    for (int round = 0; round < 20; ++round) {
        parallel_for(calls.size(), [&](std::size_t i) {
            const auto mine = shared;
            calls[i] += (*mine)[i];
        });
    }
    EXPECT_EQ(calls, std::vector<int>(shared->size(), 140));
}

TEST(Parallel, BodiesMayBeParallelThemselves) {
    std::vector<std::vector<std::size_t>> rows(50);
    parallel_for(rows.size(), [&](std::size_t i) {
        rows[i].assign(40, i);
        parallel_for(rows[i].size(), [&](std::size_t k) { rows[i][k] += k; });
        rows[i].push_back(rows[i].back());
    });
    for (std::size_t i = 0; i < rows.size(); ++i) {
        ASSERT_EQ(rows[i].size(), 41u);
        EXPECT_EQ(rows[i][3], i + 3);
        EXPECT_EQ(rows[i].back(), i + 39);
    }
}

TEST(Parallel, NothingToDoCallsNothing) {
    parallel_for(0, [](std::size_t) { FAIL(); });
}

TEST(Parallel, ThrowsWhatTheSmallestIndexThrewAfterAllHaveEnded) {
    std::atomic<int> ended = 0;
    try {
        parallel_for(100, [&](std::size_t i) {
            ++ended;
            if (i % 10 == 3) {
                throw std::runtime_error(std::to_string(i));
            }
        });
        FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "3");
    }
    EXPECT_EQ(ended, 100);
}

} // namespace
} // namespace foam
