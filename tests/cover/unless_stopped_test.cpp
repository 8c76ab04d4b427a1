// Work that ends in the middle once the caller of a search asks for it.
#include "search/src/by_spheres/portfolio/problem.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/base/parallel.hpp>

#include <gtest/gtest.h>

#include <stdexcept>

namespace {

using namespace foam;
using foam::search::by_spheres::completed_unless_stopped;

/// Works until it is cancelled.
void work_for_ever() {
    for (;;) {
        check_cancelled();
    }
}

TEST(UnlessStopped, WithoutStopOrIfItNeverAsksTheWorkIsCompleted) {
    int done = 0;
    EXPECT_TRUE(completed_unless_stopped({}, [&] { ++done; }));
    EXPECT_TRUE(completed_unless_stopped([] { return false; }, [&] { ++done; }));
    EXPECT_EQ(done, 2);
}

TEST(UnlessStopped, EndsInTheMiddle) {
    int asked = 0;
    EXPECT_FALSE(completed_unless_stopped([&] { return ++asked == 3; }, work_for_ever));
    EXPECT_EQ(asked, 3);
    EXPECT_FALSE(cancelled());
}

TEST(UnlessStopped, EndsWorkOnOtherThreads) {
    EXPECT_FALSE(
        completed_unless_stopped([] { return true; }, [] { parallel_for(4, [](std::size_t) { work_for_ever(); }); }));
}

TEST(UnlessStopped, ExceptionsOfStopPassThrough) {
    const auto stop = []() -> bool { throw std::runtime_error("interrupted"); };
    EXPECT_THROW(completed_unless_stopped(stop, work_for_ever), std::runtime_error);
    EXPECT_THROW(completed_unless_stopped([] { return false; }, [] { throw std::runtime_error("work"); }),
                 std::runtime_error);
}

TEST(UnlessStopped, StopItselfMayCheckForCancellation) {
    EXPECT_FALSE(completed_unless_stopped(
        [] {
            check_cancelled();
            return true;
        },
        work_for_ever));
}

class Request : public StopRequest {
public:
    bool asked() const override { return true; }
};

TEST(UnlessStopped, ARequestThatWasThereBeforeEndsTheWorkWithItsError) {
    const Request request;
    const StopScope scope(&request);
    EXPECT_THROW(completed_unless_stopped([] { return false; }, work_for_ever), Error);
}

} // namespace
