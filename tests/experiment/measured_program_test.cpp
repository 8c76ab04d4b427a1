// The memory of a measured run: its own.
#include "bench/src/measured_program.hpp"

#include "support/temporary_folder.hpp"

#include <gtest/gtest.h>

namespace {

using namespace foam;
using namespace foam::bench::experiment;

TEST(MeasuredProgram, MemoryIsThatOfTheProgramNotOfTheOneThatMeasures) {
    const TemporaryFolder folder;
    const std::vector<char> held(std::size_t{300} << 20, 1); // in the memory of this process
    const MeasuredProgram sleeping = run_measured("/bin/sleep", {"0.2"}, 10, folder.path());
    EXPECT_EQ(sleeping.exit_code, 0);
    EXPECT_GT(sleeping.memory, 100e3);
    EXPECT_LT(sleeping.memory, 100e6) << held.back();
}

TEST(MeasuredProgram, EndsAtTheLimitOfTime) {
    const TemporaryFolder folder;
    const MeasuredProgram busy = run_measured("/bin/sh", {"-c", "while :; do :; done"}, 0.5, folder.path());
    EXPECT_TRUE(busy.over_limit);
    EXPECT_GT(busy.cpu_seconds, 0.5);
}

} // namespace
